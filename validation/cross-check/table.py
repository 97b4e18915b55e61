"""CSV files as gearwear writes them: lines with # first, then the names of the columns, then rows."""

import csv


def read(path):
    """The rows as dictionaries of words."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def write(path, notes, columns, rows):
    """Writes the rows, numbers with seven digits, which is what CalculiX prints."""
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.writelines(f"# {note}\n" for note in notes)
        file.write(",".join(columns) + "\n")
        file.writelines(",".join(f"{value:.7g}" for value in row) + "\n" for row in rows)
