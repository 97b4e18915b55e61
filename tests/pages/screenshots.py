"""Opens a page of every kind in headless Chromium and checks how it is drawn.

    pip install playwright                       # and Chromium from the system
    python tests/pages/screenshots.py --program target/release/gearwear --out out/pages

Small examples of every kind of page are computed into --out/runs (those that are there already are kept), and each page is
opened at 1280 and 390 px, light and dark, and printed. Pictures (PNG, PDF) go to --out. It fails where a page

- writes an error to the console,
- is wider than the window, or has a table that is wider than its room,
- has labels of one axis, or of one plot, that overlap,
- has a curve that is not clipped to its plot area,
- has an axis whose title does not fit beside it,
- has a plot whose data go beyond the range of its axis, where they would be cut off without a word,
- has a slider that does not change what is said beside it,
- of a run, does not begin its first picture within the first screen, or is not one sheet of A4 where all its parts are closed.

Only some: --only run-spur --only sweep-2d.
"""

import argparse
import csv
import pathlib
import random
import re
import shutil
import subprocess
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]

# Every page: its name, and the commands that make its folder. {s}: folder of the scenes, {o}: folder of the page.
PAGES = {
    "run-spur": ["run {s}/spur.toml --out {o}"],
    "run-phases": ["run {s}/phases.toml --out {o}"],
    "run-temperature": ["run {s}/temperature.toml --out {o}"],
    "run-films": ["run {s}/films.toml --out {o}"],
    "run-each-gear": ["run {s}/each-gear.toml --out {o}"],
    "run-adsorption": ["run {s}/adsorption.toml --out {o}"],
    "run-fem": ["run {s}/fem.toml --out {o}"],
    "run-severe": ["run {s}/severe.toml --out {o}"],
    "run-helical-preset": ["run {s}/helical-preset.toml --out {o}"],
    "run-helical": ["run {s}/helical.toml --out {o}"],
    "run-helical-films": ["run {s}/helical-films.toml --out {o}"],
    "calibrate": ["calibrate {s}/spur.toml --out {o}/pair.calibration.json"],
    "fem-pair": ["fem {s}/spur.toml --out {o}"],
    "fem-position": ["fem {s}/spur.toml --position 12 --out {o}"],
    "fem-plane": ["fem {s}/roller.toml --out {o}"],
    "fem-space": ["fem {s}/plate.toml --out {o}"],
    "sweep-1d": ["sweep {s}/spur.toml --vary operation.pinion_torque_Nm=100:300:4 --out {o}"],
    "sweep-2d": [
        "sweep {s}/spur.toml --vary operation.pinion_torque_Nm=100:300:4 --vary pair.pinion.profile_shift=0.1:0.2:3 --out {o}"
    ],
    "uncertainty": [
        "uncertainty {s}/spur.toml --uncertain wear.coefficient_m2_per_N=lognormal:1.5 --uncertain operation.pinion_torque_Nm=±10% "
        "--limit pinion.peak_wear_um=1 --samples 16 --out {o}"
    ],
    "sweep-words": ["sweep {s}/spur.toml --vary contact.surface=half-space,winkler --vary operation.pinion_torque_Nm=100,300 --out {o}"],
    "sweep-best": [
        "sweep {s}/spur.toml --vary wear.coefficient_m2_per_N=1e-19:1e-17:4:log --best pinion.peak_wear_um "
        "--subject-to wheel.peak_wear_um<=8 --out {o}"
    ],
    "compare-measured": ["run {s}/spur.toml --out {o}", "compare {o} {s}/trace.csv --shift-within 0 --out {o}/compared"],
    "compare-flanks": ["run {s}/spur.toml --out {o}", "compare {o} {o}/pinion-trace.csv {o}/wheel-trace.csv --out {o}/compared"],
    "compare-history": [
        "run {s}/spur.toml --out {o}",
        "compare {o} --history {s}/history.csv --limit pinion.peak_wear_um=30 --out {o}/compared",
    ],
    "compare-runs": ["compare {s}/spur.toml {s}/heavy.toml --out {o}"],
    "compare-helical": ["compare {s}/helical.toml {s}/helical-heavy.toml --out {o}"],
    "accuracy": ["accuracy {s}/spur.toml --out {o}"],
    "accuracy-helical": ["accuracy {s}/helical-small.toml --out {o}"],
    "validate": ["validate fzg-c-geometry exact-wear nafems-cylinder --out {o}"],
}

# Height of a screen of a telephone.
SCREEN_PX = 844

# In the page: what is wrong with it as it is drawn.
LOOK = r"""() => {
    const wrong = [];
    const root = document.documentElement;
    if (root.scrollWidth > root.clientWidth + 1) {
        let widest = null;
        for (const e of document.body.querySelectorAll("*")) {
            const box = e.getBoundingClientRect();
            if (box.right > root.clientWidth + 1 && (!widest || box.right > widest.getBoundingClientRect().right)) widest = e;
        }
        wrong.push(`page ${root.scrollWidth} px wide in ${root.clientWidth} px` +
            (widest ? `: <${widest.tagName.toLowerCase()} class="${widest.getAttribute("class") || ""}"> ` +
                (widest.textContent || "").trim().slice(0, 40) : ""));
    }
    const name = e => (e.closest("section,figure,details") || document.body).querySelector("h2,h3,figcaption,summary")?.textContent.slice(0, 50);
    const over = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1.5 &&
        Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 2.5;
    for (const svg of document.querySelectorAll("svg")) {
        const texts = [...svg.querySelectorAll("text")].filter(t => {
            const box = t.getBoundingClientRect();
            const style = getComputedStyle(t);
            return box.width > 0 && t.textContent.trim() && style.visibility !== "hidden" && +style.opacity > 0.05 &&
                !t.closest("[transform*='rotate'],defs") && !/rotate\((?!0)/.test(t.getAttribute("transform") || "");
        });
        const boxes = texts.map(text => text.getBoundingClientRect());
        for (let i = 0; i < texts.length; i++) for (let j = i + 1; j < texts.length; j++) {
            if (over(boxes[i], boxes[j])) {
                wrong.push(`labels overlap in “${name(svg)}”: “${texts[i].textContent}” and “${texts[j].textContent}”`);
            }
        }
    }
    for (const room of document.querySelectorAll(".scroll, .phases")) {
        const cut = room.scrollWidth - room.clientWidth;
        if (cut > 1) wrong.push(`a table is cut by ${cut} px: ${room.textContent.trim().slice(0, 40)}`);
    }
    for (const plot of document.querySelectorAll(".plot")) {
        // A curve that leaves the plot without being clipped is drawn over the axes.
        for (const trace of plot.querySelectorAll(".trace")) {
            if (!trace.closest("[clip-path]")) wrong.push(`a trace is not clipped in “${name(plot)}”`);
        }
        const data = JSON.parse(document.getElementById(plot.id + "-data").textContent);
        data.traces.forEach((trace, i, all) => trace.x ??= all[i - 1].x);
        // A drawing to scale shows a part on purpose; what is cut tells so in its caption.
        for (const trace of data.is_to_scale || data.is_cut ? [] : data.traces) {
            if (!trace.is_shown || trace.values || trace.hover === null) continue;
            const place = (axis, value) => axis.is_logarithmic ? Math.log10(value) : value;
            const [[left, right], [low, high]] = [data.x, data.y].map(axis => [...axis.range].sort((a, b) => a - b));
            const cut = trace.y.find((value, i) => {
                const [x, y] = [place(data.x, trace.x[i]), place(data.y, value)];
                return x >= left && x <= right && value !== null && (y < low - 0.002 * (high - low) || y > high + 0.002 * (high - low));
            });
            if (cut !== undefined) wrong.push(`“${trace.name}” is cut off in “${name(plot)}”: ${cut} outside ${data.y.range}`);
        }
        const room = plot.getBoundingClientRect();
        for (const title of plot.querySelectorAll(".titles text")) {
            const box = title.getBoundingClientRect();
            const out = box.left < room.left - 1 || box.right > room.right + 1 || box.top < room.top - 1 || box.bottom > room.bottom + 1;
            if (box.width > 0 && out) wrong.push(`the title of an axis is cut off in “${name(plot)}”: ${title.textContent}`);
        }
    }
    return [...new Set(wrong)];
}"""

# In the page: moves every slider to its other end, and names those where nothing happens.
SLIDE = r"""() => {
    const still = [];
    for (const slider of document.querySelectorAll(".slider:not([hidden])")) {
        const [input, output] = [slider.querySelector("input"), slider.querySelector("output")];
        const before = output.textContent;
        const middle = (Number(input.min) + Number(input.max)) / 2;
        input.value = Number(input.value) > middle ? input.min : input.max;
        input.dispatchEvent(new Event("input", { bubbles: true }));
        if (output.textContent === before && input.min !== input.max) still.push(`a slider changes nothing: “${before}”`);
    }
    return still;
}"""


def scenes(program: str, folder: pathlib.Path) -> None:
    """The scenes, problems and the measured profile of the examples."""
    folder.mkdir(parents=True, exist_ok=True)

    def preset(name: str) -> str:
        return subprocess.run([program, "init", name], check=True, capture_output=True, text=True).stdout

    def exchanged(text: str, *pairs: tuple[str, str]) -> str:
        for old, new in pairs:
            if old not in text:
                sys.exit(f"the preset has no {old!r} any more")
            text = text.replace(old, new)
        return text

    small = [("flank_points = 750 ", "flank_points = 200 "), ("positions = 400 ", "positions = 60 ")]
    spur = exchanged(preset("fzg-c"), *small)
    (folder / "spur.toml").write_text(spur)
    (folder / "heavy.toml").write_text(exchanged(spur, ("pinion_torque_Nm = 302.0", "pinion_torque_Nm = 350.0")))
    (folder / "severe.toml").write_text(exchanged(spur, ("# severe =", "severe =")))
    (folder / "temperature.toml").write_text(spur + "\n[temperature]\nmethod = \"williams\"\n")
    rough = [("# profile_crowning_um = 5.0", "roughness_Ra_um = 0.5"), ("teeth = 24", "teeth = 24\nroughness_Ra_um = 0.5")]
    (folder / "films.toml").write_text(exchanged(spur, *rough) + LUBRICATED)
    (folder / "each-gear.toml").write_text(
        spur + "\n[wear.pinion]\ncoefficient_m2_per_N = 2e-18\n\n[wear.wheel.severe]\nabove_MPa = 1200.0\nfactor = 10.0\n"
    )
    (folder / "adsorption.toml").write_text(
        exchanged(spur, ('law = "archard"', 'law = "adsorption"'), ("= 1e-17 ", "= 1e-13 "))
    )
    (folder / "fem.toml").write_text(exchanged(spur, ('# surface = "fem"', 'surface = "fem"')))
    phases = "".join(f"[[operation.phases]]\nhours = 20.0\npinion_torque_Nm = {torque}\n" for torque in (200.0, 302.0))
    hours = next(line for line in spur.splitlines() if line.startswith("hours"))
    shown = next(line for line in spur.splitlines() if line.startswith("snapshots_h"))
    (folder / "phases.toml").write_text(exchanged(spur, (hours, ""), (shown, "")) + "\n" + phases)
    helical = preset("thesis-helical")
    (folder / "helical.toml").write_text(helical)
    small += [("slices = 20 ", "slices = 6 ")]
    (folder / "helical-small.toml").write_text(exchanged(helical, *small))
    torque = next(line for line in helical.splitlines() if line.startswith("pinion_torque_Nm"))
    (folder / "helical-heavy.toml").write_text(exchanged(helical, (torque, "pinion_torque_Nm = 400.0")))
    rough = [(f"teeth = {z}", f"teeth = {z}\nroughness_Ra_um = 0.5") for z in (16, 24)]
    (folder / "helical-films.toml").write_text(exchanged(preset("helical"), *rough) + LUBRICATED)
    (folder / "helical-preset.toml").write_text(preset("helical"))
    for mesh, problem in [("roller.msh", ROLLER), ("plate-hex8.msh", PLATE)]:
        shutil.copy(REPOSITORY / "meshes" / mesh, folder)
        (folder / f"{mesh.split('-')[0].split('.')[0]}.toml").write_text(problem)
    rows = [(34.3 + 0.02 * i, -8 * 2.718 ** (-i / 60) + 0.1 * (i * 7 % 5 - 2)) for i in range(300)]
    lines = ["# invented", "# gear = pinion", "# uncertainty_um = 0.15", "radius_mm,height_um"]
    (folder / "trace.csv").write_text("\n".join(lines + [f"{r:.3f},{h:.3f}" for r, h in rows]) + "\n")
    weighed = "20;pinion;1;3.1;;0.3\n20;pinion;2;3.5;;0.3\n45;pinion;1;6.8;;0.3\n70;pinion;1;9.4;;0.3\n20;wheel;;;14;\n70;wheel;;;40;\n"
    (folder / "history.csv").write_text(f"hours;gear;tooth;depth_um;mass_loss_mg;sigma\n{weighed}")


LUBRICATED = """
[lubricant]
viscosity_class = 220
temperature_C = 90.0

[friction]
model = "xu"
"""

ROLLER = """title = "Roller on a block"
mesh = { file = "roller.msh" }
body = [{ group = "roller", young_modulus_GPa = 206.0, poisson_ratio = 0.3 }, { group = "block", young_modulus_GPa = 206.0, poisson_ratio = 0.3 }]
fixed = [{ group = "symmetry", components = ["x"] }, { group = "base" }]
load = [{ group = "top", force_N_per_mm = [0.0, -250.0] }]
contact = [{ slave = "running-surface", master = "track" }]
"""

PLATE = """title = "Plate"
analysis = "three-dimensional"
mesh = { file = "plate-hex8.msh" }
body = [{ group = "plate", young_modulus_GPa = 206.0, poisson_ratio = 0.3 }]
fixed = [{ group = "supported-x" }, { group = "supported-y" }, { group = "middle-x", components = ["x"] }, { group = "middle-y", components = ["y"] }]
load = [{ group = "top", force_N = [0.0, 0.0, -100.0] }]
"""


def measure(run: pathlib.Path) -> None:
    """Writes a measured profile of each flank of a run: more wear on the pinion, less on the wheel, and scatter."""
    for gear, factor in [("pinion", 1.3), ("wheel", 0.8)]:
        with open(run / f"{gear}.csv", encoding="utf-8") as table:
            worn = [(float(row["radius_mm"]), float(row["wear_um"])) for row in csv.DictReader(table) if float(row["wear_um"]) > 0]
        scatter = random.Random(1)
        points = "".join(f"{radius:.4f},{-factor * wear + scatter.gauss(0, 0.2):.3f}\n" for radius, wear in worn[10:-10])
        (run / f"{gear}-trace.csv").write_text(f"# gear = {gear}\nradius_mm,height_um\n{points}")


def compute(program: str, name: str, scene_folder: pathlib.Path, folder: pathlib.Path) -> list[pathlib.Path]:
    """The pages of one kind: those of its folder and of the folder of its comparison."""
    if not list(folder.rglob("*.html")):
        folder.mkdir(parents=True, exist_ok=True)
        for command in PAGES[name]:
            if "{o}/pinion-trace.csv" in command:
                measure(folder)
            arguments = [part.format(s=scene_folder, o=folder) for part in command.split()]
            done = subprocess.run([program, *arguments], capture_output=True, text=True)
            if done.returncode != 0:
                raise RuntimeError(f"gearwear {' '.join(arguments)}\n{done.stderr.strip()}")
    pages = sorted(folder.rglob("*.html"))
    if name in ("compare-measured", "compare-flanks", "compare-history"):
        pages = [page for page in pages if page.parent != folder]
    if name in ("compare-runs", "compare-helical"):
        pages = [page for page in pages if page.parent == folder]
    if not pages:
        raise RuntimeError("no page was written")
    return pages


def first_look(tab, media: str, sheet: pathlib.Path) -> list[str]:
    """What is wrong with the page of a run before its parts are opened; its sheet is printed to a file."""
    top = tab.evaluate("document.querySelector('.first .plot')?.getBoundingClientRect().top")
    if top is None:
        return []
    if media != "print":
        return [f"the first picture begins at {top:.0f} px"] if top > SCREEN_PX else []
    tab.pdf(path=sheet, prefer_css_page_size=True)
    sheets = len(re.findall(rb"/Type\s*/Page\b", sheet.read_bytes()))
    return [f"{sheets} sheets where one is asked for"] if sheets != 1 else []


def look(browser, page_file: pathlib.Path, name: str, out: pathlib.Path) -> list[str]:
    """Opens a page in all five ways, keeps a picture of each, and says what is wrong."""
    wrong = []
    ways = [(w, s, "screen") for w in (1280, 390) for s in ("light", "dark")] + [(1280, "light", "print")]
    for width, scheme, media in ways:
        way = "print" if media == "print" else f"{width}-{scheme}"
        # Height of a page at once, so that what is drawn when it is scrolled into view is drawn.
        context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
        tab = context.new_page()
        tab.on("console", lambda m, way=way: wrong.append(f"{way}: console: {m.text}") if m.type == "error" else None)
        tab.on("pageerror", lambda e, way=way: wrong.append(f"{way}: console: {e}"))
        tab.goto(page_file.as_uri())
        wrong += [f"{way}: {found}" for found in first_look(tab, media, out / f"{name}-sheet.pdf")]
        tab.evaluate("document.querySelectorAll('details.fold').forEach(fold => fold.open = true)")
        height = tab.evaluate("document.documentElement.scrollHeight")
        for y in range(0, height, 800):
            tab.evaluate(f"window.scrollTo(0, {y})")
            tab.wait_for_timeout(25)
        tab.evaluate("window.scrollTo(0, 0)")
        tab.wait_for_timeout(150)
        if media == "print":
            tab.emulate_media(media="print")
            tab.wait_for_timeout(150)
            wrong += [f"{way}: {found}" for found in tab.evaluate(LOOK) if "px wide" not in found]
            tab.pdf(path=out / f"{name}-print.pdf", prefer_css_page_size=True)
            context.close()
            continue
        wrong += [f"{way}: {found}" for found in tab.evaluate(LOOK)]
        tab.screenshot(path=out / f"{name}-{way}.png", full_page=True)
        wrong += [f"{way}: {found}" for found in tab.evaluate(SLIDE)]
        tab.wait_for_timeout(150)
        wrong += [f"{way}, sliders moved: {found}" for found in tab.evaluate(LOOK)]
        context.close()
    return wrong


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(REPOSITORY / "target/release/gearwear"))
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder of the pictures")
    parser.add_argument("--chromium", default=shutil.which("chromium") or shutil.which("chromium-browser"))
    parser.add_argument("--only", action="append", choices=PAGES)
    options = parser.parse_args()
    from playwright.sync_api import sync_playwright

    program = str(pathlib.Path(options.program).resolve())
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    scenes(program, out / "runs" / "scenes")
    failed = 0
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=options.chromium, args=["--no-sandbox"])
        for name in options.only or PAGES:
            try:
                wrong = []
                for page in compute(program, name, out / "runs" / "scenes", out / "runs" / name):
                    wrong += look(browser, page, name, out)
            except RuntimeError as error:
                wrong = [str(error)]
            failed += bool(wrong)
            print(f"{'wrong' if wrong else 'ok   '} {name}", *wrong, sep="\n      ", flush=True)
        browser.close()
    print(f"pictures: {options.out}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
