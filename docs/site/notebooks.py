"""Notebooks as pages: those that .ci/notebooks executed, with their outputs, and otherwise as they are kept, which the page says."""

from __future__ import annotations

import logging
import re
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files
from nbconvert import MarkdownExporter

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"
EXECUTED = Path(__file__).resolve().parents[2] / "target" / "notebooks"
LINK = re.compile(r"(\]\([\w./-]+)\.ipynb\)")
#: What pandas says of the looks of a table: here it looks like every other.
LOOKS = re.compile(r'<style.*?</style>| border="1" class="dataframe"| style="text-align: right;"', re.DOTALL)

log = logging.getLogger("mkdocs.hooks.notebooks")


def on_files(files: Files, config: Any, **_: object) -> Files:
    """A page for each notebook, with its pictures beside it; the notebook itself is there to be downloaded."""
    for notebook in sorted(FOLDER.glob("*.ipynb")):
        name = notebook.stem
        executed = EXECUTED / notebook.name
        if not executed.exists():
            log.info("%s is shown without outputs: .ci/notebooks executes it", notebook.name)
        body, resources = MarkdownExporter().from_filename(str(executed if executed.exists() else notebook))
        for picture, content in resources.get("outputs", {}).items():
            files.append(File.generated(config, f"notebooks/{name}-{picture}", content=content))
            body = body.replace(f"]({picture})", f"]({name}-{picture})")
        body = LINK.sub(r"\1.md)", LOOKS.sub("", body))
        note = f"[This page as a notebook]({notebook.name})" + ("" if executed.exists() else "; not executed here")
        title, _, rest = body.lstrip().partition("\n")
        files.append(File.generated(config, f"notebooks/{name}.md", content=f"{title}\n\n{note}\n{rest}"))
    return files
