"""Opens `gearwear explore` in headless Chromium, turns its sliders, and compares what it says with `gearwear run`.

    pip install playwright                       # and Chromium from the system
    python tests/pages/explore.py --program target/release/gearwear --out out/explore

Pictures at 1280 and 390 px, light and dark, go to --out. It fails where

- the page writes an error to the console, or is wider than the window,
- the median of 30 changes of a slider to their curves takes longer than --within-ms (0: it is printed, not judged),
- a figure or a curve differs in any digit from a run of the scene that the page saves with the same model,
- the keyboard does not move a slider, or a refused setting says nothing,
- the program does not end after its window.

--scene FILE may be given several times; without it the presets fzg-c and helical are opened.
"""

import argparse
import csv
import json
import pathlib
import shutil
import statistics
import subprocess
import sys
import time

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
CHANGES = 30


def begin(program: str, scene: pathlib.Path) -> tuple[subprocess.Popen, str]:
    """The program on a scene, and the address that it prints."""
    command = [program, "explore", str(scene), "--no-browser"]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    address = server.stdout.readline().strip()
    if not address.startswith("http://127.0.0.1:"):
        raise RuntimeError(f"no address but {address!r}")
    return server, address


def answered(tab, what: str) -> None:
    """Waits for the answer of the newest setting."""
    end = time.monotonic() + 120
    while not tab.evaluate(f"document.documentElement.dataset.{what} === String(generation)"):
        if time.monotonic() > end:
            raise RuntimeError(f"{what}: no answer; {tab.locator('#refusal').text_content()}")
        tab.wait_for_timeout(20)


def equal_to_run(program: str, tab, model: str, folder: pathlib.Path) -> list[str]:
    """Differences of the page to a run of the scene that it saves."""
    folder.mkdir(parents=True, exist_ok=True)
    saved = tab.evaluate(f"post('scene', {{ setting: setting(), model: '{model}' }})")
    for file in saved["files"]:
        (folder / file["name"]).write_text(file["text"], encoding="utf-8")
    command = [program, "run", str(folder / "scene.toml"), "--out", str(folder / "run"), "--quiet", "--no-report"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        return [done.stderr.strip()]
    answer = tab.evaluate("fast.answer" if model == "fast" else "elements.answer")
    summary = json.loads((folder / "run" / "summary.json").read_text(encoding="utf-8"))
    wrong = []
    for figure in answer["figures"]:
        value = summary
        for part in figure["name"].split("."):
            value = value[part]
        if value != figure["value"]:
            wrong.append(f"{model}: {figure['name']} {figure['value']} instead of {value}")
    tables = [("mesh_cycle", answer["mesh_cycle"])]
    if summary["helical"] is None:
        tables += [(gear, answer["flanks"][gear]) for gear in ("pinion", "wheel")]
    for name, curves in tables:
        with open(folder / "run" / f"{name}.csv", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        for column, values in curves.items():
            if column in rows[0] and [float(row[column]) for row in rows] != values:
                wrong.append(f"{model}: {column} of {name}.csv")
    return wrong


def explore(browser, program: str, scene: pathlib.Path, out: pathlib.Path, within_ms: float) -> list[str]:
    """What is wrong with the page of a scene."""
    wrong = []
    start = time.monotonic()
    server, address = begin(program, scene)
    print(f"      {scene.stem}: ready after {time.monotonic() - start:.1f} s")
    try:
        context = browser.new_context(viewport={"width": 1280, "height": 900})
        tab = context.new_page()
        tab.on("console", lambda m: wrong.append(f"console: {m.text}") if m.type == "error" else None)
        tab.on("pageerror", lambda e: wrong.append(f"console: {e}"))
        tab.goto(address)
        answered(tab, "answered")
        answered(tab, "elements")
        seconds = [float(tab.evaluate("document.documentElement.dataset.seconds"))]
        inputs = tab.locator("#sliders input")
        tab.evaluate("lags.length = 0")
        for change in range(CHANGES):
            slider = inputs.nth(change % inputs.count())
            slider.focus()
            before = slider.input_value()
            tab.keyboard.press("ArrowRight" if change // inputs.count() % 2 == 0 else "ArrowLeft")
            if slider.input_value() == before:
                tab.keyboard.press("ArrowLeft")
            answered(tab, "answered")
        lags = sorted(tab.evaluate("lags"))
        median = statistics.median(lags)
        print(f"      {scene.stem}: {len(lags)} changes, median {median:.0f} ms, greatest {lags[-1]:.0f} ms")
        if within_ms and median > within_ms:
            wrong.append(f"median of {len(lags)} changes {median:.0f} ms")
        for _ in range(3):
            inputs.first.focus()
            tab.keyboard.press("ArrowRight")
            answered(tab, "answered")
            answered(tab, "elements")
            seconds.append(float(tab.evaluate("document.documentElement.dataset.seconds")))
        print(f"      {scene.stem}: finite elements after {', '.join(f'{s:.2f}' for s in seconds)} s")
        for model in ("fast", "finite-elements"):
            wrong += equal_to_run(program, tab, model, out / "runs" / scene.stem / model)
        tab.locator("#pin").click()
        inputs.first.focus()
        for _ in range(6):
            tab.keyboard.press("ArrowRight")
        answered(tab, "answered")
        answered(tab, "elements")
        said = tab.evaluate("post('answer', { setting: { [session.sliders[0].name]: 1e9 }, model: 'fast' }).catch((error) => error.message)")
        if "allowed" not in str(said):
            wrong.append(f"a value outside its range: {said}")
        wrong[:] = [one for one in wrong if "status of 422" not in one]
        for width, scheme in [(w, s) for w in (1280, 390) for s in ("light", "dark")]:
            tab.set_viewport_size({"width": width, "height": 900})
            tab.emulate_media(color_scheme=scheme)
            tab.wait_for_timeout(150)
            if tab.evaluate("document.documentElement.scrollWidth > document.documentElement.clientWidth"):
                wrong.append(f"{width}-{scheme}: wider than the window")
            tab.screenshot(path=out / f"{scene.stem}-{width}-{scheme}.png", full_page=True)
        context.close()
        try:
            server.wait(timeout=10)
        except subprocess.TimeoutExpired:
            wrong.append("the program did not end after its window")
    finally:
        server.kill()
    return wrong


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(REPOSITORY / "target/release/gearwear"))
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder of the pictures")
    parser.add_argument("--chromium", default=shutil.which("chromium") or shutil.which("chromium-browser"))
    parser.add_argument("--within-ms", type=float, default=0, help="greatest median of the changes")
    parser.add_argument("--scene", action="append", type=pathlib.Path)
    options = parser.parse_args()
    from playwright.sync_api import sync_playwright

    program = str(pathlib.Path(options.program).resolve())
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    opened = options.scene or []
    if not opened:
        for preset in ("fzg-c", "helical"):
            text = subprocess.run([program, "init", preset], capture_output=True, text=True, check=True).stdout
            opened.append(out / f"{preset}.toml")
            opened[-1].write_text(text, encoding="utf-8")
    failed = 0
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=options.chromium, args=["--no-sandbox"])
        for scene in opened:
            wrong = explore(browser, program, scene, out, options.within_ms)
            failed += bool(wrong)
            print(f"{'wrong' if wrong else 'ok   '} {scene.stem}", *wrong, sep="\n      ", flush=True)
        browser.close()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
