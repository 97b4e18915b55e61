"""Opens the workbook of a run and compares its tables with the CSV files beside it.

    gearwear run scene.toml --workbook --out out/run
    python tests/python/check_workbook.py out/run

openpyxl, where it is installed, reads it bit for bit; LibreOffice, where `soffice` is present, opens it and writes every sheet with the 15
digits that it writes. One of the two has to be there. Ends with status 1 at the first difference.
"""

import csv
import importlib.util
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import zipfile

# All sheets as UTF-8 with commas, each to a file of its own, numbers as they are stored and not as they are shown.
FILTER = "csv:Text - txt - csv (StarCalc):44,34,76,1,,0,false,false,false,false,false,-1"


def by_libreoffice(program, workbook):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, f"-env:UserInstallation=file://{folder}/profile", "--headless", "--convert-to", FILTER,
                        "--outdir", folder, str(workbook)], check=True, stdout=subprocess.DEVNULL, timeout=300)
        sheets = {}
        for file in pathlib.Path(folder).glob("*.csv"):
            with open(file, newline="", encoding="utf-8") as lines:
                sheets[file.stem.removeprefix(workbook.stem + "-")] = list(csv.reader(lines))
        return sheets


def by_openpyxl(workbook):
    import openpyxl

    book = openpyxl.load_workbook(workbook, read_only=True)
    return {sheet.title: [["" if value is None else value for value in row] for row in sheet.iter_rows(values_only=True)]
            for sheet in book}


def same_value(text, value, tolerance):
    """Whether a cell of a sheet is that of a CSV file."""
    if text == str(value):
        return True
    try:
        return math.isclose(float(text), float(value), rel_tol=tolerance, abs_tol=0.0)
    except ValueError:
        return text.lower() == str(value).lower() and text.lower() in ("true", "false")


def check(folder, sheets, by, tolerance):
    tables = json.loads((folder / "columns.json").read_text())["files"]
    expected = {"summary", "columns"} | {name.removesuffix(".csv") for name in tables}
    assert set(sheets) == expected, f"{by}: sheets {sorted(sheets)}, not {sorted(expected)}"
    cells = 0
    for name, columns in tables.items():
        rows = sheets[name.removesuffix(".csv")]
        with open(folder / name, newline="", encoding="utf-8") as lines:
            wanted = list(csv.reader(lines))
        assert len(rows) == len(wanted), f"{by}: {name} has {len(wanted)} lines, its sheet {len(rows)}"
        assert [str(title) for title in rows[0]] == list(columns), f"{by}: columns of {name}"
        for number, (row, line) in enumerate(zip(rows, wanted)):
            row = list(row) + [""] * (len(line) - len(row))
            for column, text, value in zip(columns, line, row):
                assert same_value(text, value, tolerance), f"{by}: {name}, line {number + 1}, {column}: {value!r}, not {text}"
                cells += 1
    meanings = {(row[0], row[1]): row[3] for row in sheets["columns"][1:]}
    for name, columns in tables.items():
        for column, meaning in columns.items():
            assert meanings[(name.removesuffix(".csv"), column)] == meaning, f"{by}: meaning of {column} in {name}"
    summary = json.loads((folder / "summary.json").read_text())
    figures = {row[0]: row[1] for row in sheets["summary"][1:]}
    for path in ("pinion.peak_wear_um", "wheel.peak_wear_um", "worn.peak_pressure_MPa", "title"):
        value = summary
        for key in path.split("."):
            value = value[key]
        assert same_value(str(value), figures[path], tolerance), f"{by}: {path} is {figures[path]!r}, not {value}"
    print(f"{by}: {len(sheets)} sheets, {cells} cells as in the CSV files")


def main():
    folder = pathlib.Path(sys.argv[1])
    workbook = folder / "results.xlsx"
    assert zipfile.ZipFile(workbook).testzip() is None, "the workbook is no whole archive"
    program = shutil.which("soffice")
    has_openpyxl = importlib.util.find_spec("openpyxl") is not None
    assert program or has_openpyxl, "neither openpyxl nor LibreOffice is here"
    if program:
        check(folder, by_libreoffice(program, workbook), "LibreOffice", tolerance=1e-14)
    else:
        print("LibreOffice (soffice) is missing: whether the workbook opens in it is not checked")
    if has_openpyxl:
        check(folder, by_openpyxl(workbook), "openpyxl", tolerance=0.0)


main()
