"""Runs the program on spoiled input and checks that it says so: Python's standard library alone.

    cargo build --release
    python tests/hostile/hostile.py --program target/release/gearwear --seed 1 --count 500

Presets, scenes, meshes of every format, finite-element problems, cases of the validation suite, calibrations, stiffness curves and
measured profiles are changed at random (numbers, keys, lines, bytes), the same ones for the same seed, and the program is run on each,
with one thread, at most --seconds of processor time and --gigabytes of memory. A case is an offender where the program

- ends with another status than 0, 1, 2 or 3, by a signal, or with a panic,
- refuses its input (status 2) without a place: file and line, an option, or a key,
- takes more than the limits without having announced how much it takes,
- ends a run without the balance of its worn volumes (`wear_balance`), or leaves a temporary file behind.

What takes more than the limits and has announced it is ended, and counted apart. Exit status 1 where there are offenders; their input is
kept in --keep, each in a folder of its own with the command and what was said.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PRESETS = ["fzg-c", "fzg-a", "helical", "thesis-spur", "thesis-helical", "h501"]
COARSE = "\n[numerics]\nflank_points = 120\npositions = 40\nerror_estimate = false\nverify = false\n"
CURVE = "# flattening = excluded\nposition_mm,stiffness_N_per_mm_um\n4.4723,14.2\n14.0,19.8\n23.5694,15.1\n"
# How much it takes, said before it is taken.
ANNOUNCED = re.compile(r"some [\d.]+ (GB|s|min)\b|, \d+ s left")
PLACES = [
    re.compile(r"[^\s:]+\.\w+(: line |:)\d+|, line \d+"),  # file and line
    re.compile(r"standard input:\d+"),
    re.compile(r"--[a-z]"),  # an option
    re.compile(r"(^|\s)[a-z_]+(\[\d+\])?(\.[A-Za-z_\d]+(\[\d+\])?)+: "),  # a key
]
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.])")
STRANGE = ["0", "-0.0", "-1", "1", "nan", "inf", "-inf", "1e308", "-1e308", "5e-324", "1e-30", "1e30", "1e70", "1e-265", "18446744073709551616",
           "2147483648", "0.5", "1e6", "1e-6", "true", '"text"', "[]", "{}", "[1, 2]", "", "30,5", "0x10", "1_000", "2026-01-01"]
WORDS = ["winkler", "hertz", "hertz-mean", "half-space", "fem", "adaptive", "slicing", "none", "constant", "iso6336", "adsorption", "oxidation",
         "sector", "ring", "half-width", "approach", "peak-pressure", "priest-taylor", "table"]


def scaled(rng, text):
    """A number near this one, or far from it, as it might be mistyped."""
    try:
        value = float(text)
    except ValueError:
        return "1"
    factor = rng.choice([-1.0, 10.0, 0.1, 1000.0, 0.001, 1e6, 1e-6, rng.uniform(0.3, 3.0), rng.uniform(0.9, 1.1), rng.uniform(0.9, 1.1)])
    changed = value * factor if value else rng.uniform(-1.0, 1.0)
    if re.fullmatch(r"[-+]?\d+", text) and rng.random() < 0.8 and abs(changed) < 1e15:
        return str(round(changed))
    return repr(changed)


def change_number(rng, text):
    numbers = list(NUMBER.finditer(text))
    if not numbers:
        return text
    found = rng.choice(numbers)
    new = scaled(rng, found.group()) if rng.random() < 0.7 else rng.choice(STRANGE)
    return text[: found.start()] + new + text[found.end():]


def change_line(rng, text):
    lines = text.split("\n")
    at, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    match rng.randrange(5):
        case 0:
            del lines[at]
        case 1:
            lines.insert(other, lines[at])
        case 2:
            lines[at], lines[other] = lines[other], lines[at]
        case 3:
            lines[at] = lines[at][: rng.randrange(len(lines[at]) + 1)]
        case _:
            # Back into the file, where it is a comment.
            lines[at] = lines[at].removeprefix("# ")
    return "\n".join(lines)


def change_word(rng, text):
    words = list(re.finditer(r'"[\w-]+"', text))
    if not words:
        return change_line(rng, text)
    found = rng.choice(words)
    return text[: found.start()] + f'"{rng.choice(WORDS)}"' + text[found.end():]


def change_bytes(rng, text):
    data = bytearray(text.encode("utf-8", "surrogateescape"))
    if not data:
        return "\x00"
    at = rng.randrange(len(data))
    match rng.randrange(4):
        case 0:
            data[at] = rng.randrange(256)
        case 1:
            del data[at:]
        case 2:
            del data[at: at + rng.randrange(1, 20)]
        case _:
            data[at:at] = rng.randbytes(rng.randrange(1, 8))
    return data.decode("utf-8", "surrogateescape")


def spoiled(rng, text, at_most=3):
    """`text` with one to three changes, most of them to numbers."""
    for _ in range(rng.randint(1, at_most)):
        change = rng.choices([change_number, change_line, change_word, change_bytes], [12, 3, 2, 1])[0]
        text = change(rng, text)
    return text


def read(path):
    return pathlib.Path(path).read_bytes().decode("utf-8", "surrogateescape")


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text.encode("utf-8", "surrogateescape"))


#: Wear at several times.
HISTORY = """hours;gear;tooth;depth_um;mass_loss_mg;profile;sigma
20;pinion;1;3.1;;;0.3
20;pinion;2;3.5;;;0.3
31.75;pinion;;;;trace.csv;
70;pinion;1;9.4;;;
20;wheel;;;14;;2
70;wheel;;;40;;2
"""


class Sources:
    """What is spoiled: sound files, made once by the program itself where it makes such."""

    def __init__(self, program, folder):
        def made(*arguments):
            done = subprocess.run([program, *arguments], capture_output=True, cwd=folder)
            if done.returncode != 0:
                sys.exit(f"{' '.join(map(str, arguments))}: {done.stderr.decode()}")
            return done.stdout.decode()

        self.presets = {name: made("init", name) for name in PRESETS}
        table = re.compile(r"^\[numerics\].*?(?=^\[|\Z)", re.MULTILINE | re.DOTALL)
        self.coarse = {name: table.sub("", text) + COARSE for name, text in self.presets.items()}
        calibrated = self.coarse["fzg-c"].replace('surface = "half-space"', 'surface = "winkler"\ncalibration = "c.json"')
        self.calibrated = calibrated
        write(folder / "fzg-c.toml", self.coarse["fzg-c"] + "\n[fem]\nelements_per_half_width = 3\n")
        made("calibrate", "fzg-c.toml", "--out", "c.json", "-q")
        self.calibration = read(folder / "c.json")
        self.curved = self.coarse["thesis-spur"].replace('model = "constant"', 'model = "simon"\ncurve = "curve.csv"', 1)
        write(folder / "worn.toml", self.coarse["thesis-spur"])
        made("run", "worn.toml", "--out", "worn", "-q", "--no-report")
        self.worn = folder / "worn"
        places = [0.1 * i for i in range(40)]
        profile = lambda gear, first: f"# gear = {gear}\n# hours = 31.75\nradius_mm,height_um\n" + "".join(
            f"{first + x:.3f},{-0.5 * x * (4.0 - x):.4f}\n" for x in places)
        self.profile, self.wheel_profile = profile("pinion", 37.0), profile("wheel", 53.0)
        for ending in ["inp", "vtu", "json", "msh"]:
            made("mesh", "fzg-c.toml", "--out", f"pair.{ending}")
        meshes = REPOSITORY / "meshes"
        self.problems = [(path, read(path)) for path in sorted(REPOSITORY.glob("validation/*/*.toml")) + sorted(meshes.glob("*.toml"))
                         if "[mesh]" in read(path)]
        self.meshes = [path for path in sorted(meshes.rglob("*")) if path.suffix in {".msh", ".vtu", ".inp"}]
        self.meshes += [folder / f"pair.{ending}" for ending in ["inp", "vtu", "json", "msh"]]
        self.cases = [path for path in sorted(REPOSITORY.glob("validation/*/case.toml")) if 'tier = "smoke"' in path.read_text()]


class Case:
    """One command in a folder of its own."""

    def __init__(self, kind, rng, sources, folder):
        self.kind, self.folder, self.out = kind, folder, folder / "out"
        getattr(self, kind)(rng, sources)

    def scene(self, rng, sources, coarse):
        texts = sources.coarse if coarse else sources.presets
        write(self.folder / "scene.toml", spoiled(rng, texts[rng.choice(PRESETS)]))

    def run(self, rng, sources):
        self.scene(rng, sources, coarse=rng.random() < 0.8)
        self.command = ["run", "scene.toml", "--out", "out", "--threads", "1"]

    def plan(self, rng, sources):
        self.scene(rng, sources, coarse=False)
        self.command = ["plan", "scene.toml"]

    def mesh(self, rng, sources):
        self.scene(rng, sources, coarse=False)
        space = ["--three-dimensional"] if rng.random() < 0.5 else []
        self.command = ["mesh", "scene.toml", "--out", f"out.{rng.choice(['msh', 'vtu', 'inp', 'json'])}", *space]

    def fem(self, rng, sources):
        self.scene(rng, sources, coarse=True)
        at = ["--position", rng.choice(["12", "9.5", "20", "0", "1e9"])] if rng.random() < 0.5 else []
        self.command = ["fem", "scene.toml", "--out", "out", "--threads", "1", *at]

    def calibrate(self, rng, sources):
        self.scene(rng, sources, coarse=True)
        self.command = ["calibrate", "scene.toml", "--out", "c.json", "--threads", "1"]

    def sweep(self, rng, sources):
        write(self.folder / "scene.toml", spoiled(rng, sources.coarse["thesis-spur"]))
        vary = rng.choice(["operation.pinion_torque_Nm=100:300:3", "pair.face_width_mm=1,14,1e9", "pair.pinion.teeth=16:18:3",
                           "material.young_modulus_GPa=1e-265:206:2", "stiffness.model=constant,iso6336", "wear.coefficient_m2_per_N=nan:1:2"])
        self.command = ["sweep", "scene.toml", "--vary", vary, "--out", "out", "--threads", "1"]

    def calibration(self, rng, sources):
        write(self.folder / "scene.toml", sources.calibrated)
        write(self.folder / "c.json", spoiled(rng, sources.calibration))
        self.command = ["run", "scene.toml", "--out", "out", "--threads", "1"]

    def curve(self, rng, sources):
        write(self.folder / "scene.toml", sources.curved)
        write(self.folder / "curve.csv", spoiled(rng, CURVE))
        self.command = ["run", "scene.toml", "--out", "out", "--threads", "1"]

    def measured(self, rng, sources):
        write(self.folder / "trace.csv", spoiled(rng, sources.profile))
        fit = rng.choice([["--fit", "none"], ["--fit", "k"], ["--form", "involute"]])
        traces = ["trace.csv"]
        if rng.random() < 0.4:
            write(self.folder / "wheel.csv", rng.choice([sources.wheel_profile, spoiled(rng, sources.wheel_profile)]))
            traces.append("wheel.csv")
        self.command = ["compare", str(sources.worn), *traces, "--out", "out", "--threads", "1", *fit]

    def history(self, rng, sources):
        write(self.folder / "history.csv", spoiled(rng, HISTORY))
        write(self.folder / "trace.csv", rng.choice([sources.profile, spoiled(rng, sources.profile)]))
        limit = rng.choice(["pinion.peak_wear_um=30", "wheel.worn_mass_mg=120", "pinion.peak_wear_um=1e9", "pinion.worn_volume_mm3=1e-9"])
        prior = rng.choice([[], ["--prior", rng.choice(["mild", "1e-18:1e-15", "1e-24:2e-24"])]])
        self.command = ["compare", str(sources.worn), "--history", "history.csv", "--limit", limit, *prior, "--out", "out", "--threads", "1"]

    def problem(self, rng, sources):
        path, text = rng.choice(sources.problems)
        whole = lambda found: f'file = "{path.parent / found.group(1)}"'
        text = re.sub(r'file = "([^"]+)"', whole, text)
        write(self.folder / "problem.toml", spoiled(rng, text))
        self.command = ["fem", "problem.toml", "--out", "out"]

    def own_mesh(self, rng, sources):
        mesh = rng.choice(sources.meshes)
        name = f"mesh{mesh.suffix}"
        groups = {"cylinder": ("cylinder", "block", "base", "top"), "plate": ("plate", "plate", "fixed", "load")}
        key = next((key for key in groups if key in mesh.name), None)
        body, other, base, top = groups.get(key, ("pinion", "wheel", "pinion-clamp", "pinion-flanks"))
        problem = f'[mesh]\nfile = "{name}"\n'
        for group in dict.fromkeys([body, other]):
            problem += f'[[body]]\ngroup = "{group}"\nyoung_modulus_GPa = 206.0\npoisson_ratio = 0.3\n'
        problem += f'[[fixed]]\ngroup = "{base}"\n[[load]]\ngroup = "{top}"\nforce_N_per_mm = [0.0, -100.0]\n'
        # The meshes of one family differ in their elements, not in their groups.
        family = mesh.stem.rpartition("-")[0] or mesh.stem
        fitting = [text for _, text in sources.problems if f"{family}-" in text or f"{mesh.name}\"" in text]
        if fitting:
            problem = re.sub(r'file = "[^"]+"', f'file = "{name}"', rng.choice(fitting))
        write(self.folder / "problem.toml", problem)
        write(self.folder / name, spoiled(rng, read(mesh)))
        self.command = ["fem", "problem.toml", "--out", "out"]

    def validation_case(self, rng, sources):
        path = rng.choice(sources.cases)
        target = self.folder / path.parent.name
        shutil.copytree(path.parent, target)
        write(target / "case.toml", spoiled(rng, read(path)))
        self.command = ["validate", f"./{path.parent.name}", "--tier", "smoke", "--out", "out", "--threads", "1"]


KINDS = {"run": 24, "plan": 20, "mesh": 10, "fem": 8, "calibrate": 4, "sweep": 4, "calibration": 5, "curve": 5, "measured": 6, "history": 4, "problem": 8,
         "own_mesh": 10, "validation_case": 4}


def judged(case, program, limits):
    """Runs a case: what is wrong with it (None: nothing), how it ended, and what it took."""
    seconds, bytes_ = limits
    said_path = case.folder / "stderr.txt"

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
        # Address space is several times what is in memory.
        resource.setrlimit(resource.RLIMIT_AS, (4 * bytes_, 4 * bytes_))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    with open(said_path, "wb") as err:
        process = subprocess.Popen([program, *case.command], cwd=case.folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=err,
                                   preexec_fn=limit)
    deadline = time.monotonic() + 30 * seconds
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            break
        if time.monotonic() > deadline:
            os.kill(process.pid, signal.SIGKILL)
        time.sleep(0.005)
    code = os.waitstatus_to_exitcode(status)
    process.returncode = code
    took_s, took_bytes = usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss
    said = said_path.read_text("utf-8", "replace")
    is_announced = ANNOUNCED.search(said) is not None
    end = f"status {code}" if code >= 0 else signal.Signals(-code).name
    took = f"{took_s:.1f} s, {1e-9 * took_bytes:.2f} GB"
    if "panicked at" in said:
        return "panic", end, took
    out_of_time = code in {-signal.SIGXCPU, -signal.SIGKILL}
    out_of_memory = took_bytes > bytes_ or "memory allocation of" in said
    if out_of_time or out_of_memory or took_s > seconds:
        what = "time" if out_of_time or took_s > seconds else "memory"
        return (None, "announced", took) if is_announced else (f"{what} not announced", end, took)
    if code not in {0, 1, 2, 3}:
        return "signal or another status", end, took
    if code != 0 and not said.strip():
        return "nothing said", end, took
    if code == 2 and not any(place.search(said) for place in PLACES):
        return "refused without a place", end, took
    if code in {0, 3} and case.kind in {"run", "calibration", "curve"} and (case.out / "summary.json").exists():
        summary = json.loads((case.out / "summary.json").read_text())
        if code == 0 and "worn" not in summary.get("wear_balance", {}):
            return "no balance of volumes", end, took
    if case.out.is_dir() and any(path.name.startswith((".gearwear-", ".tmp")) for path in case.out.rglob("*")):
        return "leftovers", end, took
    return None, end, took


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default=REPOSITORY / "target/release/gearwear", type=pathlib.Path)
    parser.add_argument("--seed", default=1, type=int)
    parser.add_argument("--count", default=300, type=int)
    parser.add_argument("--kinds", default=",".join(KINDS), help="some of: %(default)s")
    parser.add_argument("--seconds", default=20, type=int, help="of processor time")
    parser.add_argument("--gigabytes", default=1.0, type=float, help="of resident memory")
    parser.add_argument("--jobs", default=os.cpu_count() or 1, type=int)
    parser.add_argument("--keep", default=REPOSITORY / "out/hostile", type=pathlib.Path, help="folder for offenders")
    arguments = parser.parse_args()
    program = arguments.program.resolve()
    kinds = arguments.kinds.split(",")
    if unknown := set(kinds) - set(KINDS):
        sys.exit(f"--kinds: found {', '.join(sorted(unknown))}; allowed: {', '.join(KINDS)}")
    weights = [KINDS[kind] for kind in kinds]
    limits = (arguments.seconds, int(1e9 * arguments.gigabytes))
    ends, offenders = collections.Counter(), []
    with tempfile.TemporaryDirectory(prefix="hostile-") as work:
        work = pathlib.Path(work)
        (work / "sources").mkdir()
        sources = Sources(program, work / "sources")

        def one(number):
            # Each case has its own numbers: the same with any number of jobs.
            rng = random.Random(f"{arguments.seed}-{number}")
            folder = work / f"{arguments.seed}-{number}"
            folder.mkdir()
            case = Case(rng.choices(kinds, weights)[0], rng, sources, folder)
            wrong, end, took = judged(case, program, limits)
            if wrong:
                write(folder / "command.txt", " ".join(["gearwear", *case.command]) + f"\n{wrong}: {end}, {took}\n")
                kept = arguments.keep / folder.name
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(folder, kept)
            shutil.rmtree(folder)
            return number, case.kind, wrong, end, took

        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            for number, kind, wrong, end, took in pool.map(one, range(arguments.count)):
                ends[(kind, end)] += 1
                if wrong:
                    offenders.append((number, kind, wrong, end, took))
                    print(f"{arguments.seed}-{number} {kind}: {wrong} ({end}, {took})", flush=True)
    for kind in kinds:
        own = ", ".join(f"{count} × {end}" for (of, end), count in sorted(ends.items()) if of == kind)
        print(f"{kind:16} {own}")
    print(f"seed {arguments.seed}: {arguments.count} cases, {len(offenders)} offenders" + (f", kept in {arguments.keep}" if offenders else ""))
    sys.exit(1 if offenders else 0)


if __name__ == "__main__":
    main()
