"""Pages of the site that do not lie in ``docs``: README.md as the first page, what documents link to elsewhere in the repository, and the
reference of the Python package from its docstrings.

Links of the documents lead to files of the repository. A linked Markdown file becomes a page under its own path, another file is copied. Headings have the anchors that GitHub gives them.
"""

from __future__ import annotations

import ast
import posixpath
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

REPOSITORY = Path(__file__).resolve().parents[2]
REFERENCE = "python-reference.md"
LINK = re.compile(r"(?<=\]\()([^)\s]+)(?=\))")
FENCE = re.compile(r"^```")
ROLE = re.compile(r":(?:class|meth|func|attr|mod):<code>([^<]*)</code>")


def slug(heading: str, separator: str) -> str:
    """The anchor that GitHub gives to a heading, as ``tests/documents`` knows it."""
    kept = "".join(letter for letter in heading if letter.isalnum() or letter in " -_")
    return kept.lower().replace(" ", separator)


def on_config(config: Any) -> Any:
    config.mdx_configs.setdefault("toc", {})["slugify"] = slug
    return config


def on_files(files: Files, config: Any, **_: object) -> Files:
    """Adds README.md, and what documents link to outside ``docs``, and what that links to."""
    waiting = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "ARCHITECTURE.md"]
    waiting += [f"docs/{file.src_uri}" for file in files.documentation_pages()]
    seen = set(waiting)
    while waiting:
        path = waiting.pop()
        if path.endswith(".md"):
            text = (REPOSITORY / path).read_text(encoding="utf-8")
            linked = {target for _, target in linked_files(path, text)}
            waiting += sorted(linked - seen)
            seen |= linked
            if not path.startswith("docs/"):
                files.append(File.generated(config, of_site(path), content=with_site_links(path, text)))
        elif not path.startswith("docs/"):
            files.append(File.generated(config, of_site(path), content=(REPOSITORY / path).read_bytes()))
    style = (Path(__file__).parent / "site.css").read_text(encoding="utf-8")
    files.append(File.generated(config, "assets/site.css", content=style))
    files.append(File.generated(config, REFERENCE, content=reference()))
    return files


def on_page_markdown(markdown: str, page: Any, **_: object) -> str:
    """Links of a document as they are on the site."""
    return markdown if page.file.generated_by else with_site_links(f"docs/{page.file.src_uri}", markdown)


def on_page_content(content: str, page: Any, **_: object) -> str:
    """Docstrings name other parts of the package by roles: they are read as code."""
    return ROLE.sub(lambda found: f"<code>{found[1]}</code>", content) if page.file.src_uri == REFERENCE else content


def of_site(path: str) -> str:
    """Where a file of the repository lies on the site."""
    if path == "README.md":
        return "index.md"
    return path.removeprefix("docs/").replace(".ipynb", ".md")


def linked_files(path: str, text: str) -> Iterator[tuple[str, str]]:
    """Links of the document at ``path`` to files of the repository: as written, and the file's path."""
    for target in (link for line in lines_outside_code(text) for link in LINK.findall(line)):
        if "://" in target or target.startswith(("#", "mailto:")):
            continue
        file = posixpath.normpath(posixpath.join(posixpath.dirname(path), target.partition("#")[0]))
        if (REPOSITORY / file).is_file():
            yield target, file


def with_site_links(path: str, text: str) -> str:
    """The document at ``path`` with its links between pages as they lie on the site."""
    for target, file in sorted(set(linked_files(path, text))):
        anchor = target.partition("#")[2]
        there = posixpath.relpath(of_site(file), posixpath.dirname(of_site(path)) or ".")
        text = text.replace(f"]({target})", f"]({there}#{anchor})" if anchor else f"]({there})")
    return text


def lines_outside_code(text: str) -> Iterator[str]:
    code = False
    for line in text.splitlines():
        fence = FENCE.match(line) is not None
        code ^= fence
        if not code and not fence:
            yield line


def reference() -> str:
    """A page of what the package offers: every name of its ``__all__``, from the module that has it."""
    package = ast.parse((REPOSITORY / "python/gearwear/__init__.py").read_text(encoding="utf-8"))
    homes: dict[str, str] = {}
    offered: list[str] = []
    for statement in package.body:
        if isinstance(statement, ast.ImportFrom):
            homes.update({name.asname or name.name: f"{statement.module}.{name.name}" for name in statement.names})
        elif isinstance(statement, ast.Assign):
            offered = ast.literal_eval(statement.value)
    shown = sorted((name for name in offered if not name.startswith("_")), key=str.lower)
    entries = "\n\n".join(f"::: {homes[name]}" for name in shown)
    return f"# Reference of the Python package\n\n[From Python](python.md) shows how these are used.\n\n{entries}\n"
