"""Equations as MathML, which browsers draw themselves: nothing runs or is loaded when a page is read.

Documents write displayed equations as GitHub reads them, in a fence ``math`` or between ``$$``, with ``\\tag{…}`` for the number, and
those within a line between ``$``. LaTeX that cannot be read ends the build with its text. The font, STIX Two Math, is the one in the package ziamath.
"""

from __future__ import annotations

import html
import re
from importlib.metadata import distribution
from pathlib import Path
from typing import Any

from latex2mathml.converter import convert
from mkdocs.structure.files import File, Files
from pymdownx.arithmatex import arithmatex_fenced_format

DISPLAYED = re.compile(r'<div class="arithmatex">\\\[(.*?)\\\]</div>', re.DOTALL)
INLINE = re.compile(r'<span class="arithmatex">\\\((.*?)\\\)</span>', re.DOTALL)
#: Rows of equations, and what the converter knows that is set alike.
ENVIRONMENTS = (("aligned", "align*"), ("gathered", "matrix"))
#: Names of functions that stand before an argument without brackets: as operators they get the space that LaTeX leaves.
FUNCTION = re.compile(r"<mi>(arc(?:cos|sin|tan)|cos|sin|tan|ln|exp)</mi>(?!<mo|<mrow><mo)")
TAG = re.compile(r"\\tag\{([^}]*)\}")


def on_config(config: Any) -> Any:
    """Fences of the language ``math`` are equations."""
    fences = config.mdx_configs.setdefault("pymdownx.superfences", {}).setdefault("custom_fences", [])
    fences.append({"name": "math", "class": "arithmatex", "format": arithmatex_fenced_format(which="generic")})
    return config


def on_files(files: Files, config: Any, **_: object) -> Files:
    """The font, beside the style that names it."""
    font = Path(distribution("ziamath").locate_file("ziamath/fonts/STIXTwoMath-Regular.ttf"))
    files.append(File.generated(config, "assets/stix-two-math.ttf", content=font.read_bytes()))
    return files


def on_page_content(content: str, page: Any, **_: object) -> str:
    """The page with its equations drawn."""

    def displayed(found: re.Match[str]) -> str:
        latex = html.unescape(found[1])
        number = TAG.search(latex)
        drawn = _drawn(TAG.sub("", latex), "block", page)
        if number is None:
            return f'<div class="equation">{drawn}</div>'
        return f'<div class="equation" id="eq-{number[1]}">{drawn}<span>({number[1]})</span></div>'

    content = DISPLAYED.sub(displayed, content)
    return INLINE.sub(lambda found: _drawn(html.unescape(found[1]), "inline", page), content)


def _drawn(latex: str, display: str, page: Any) -> str:
    for environment, known in ENVIRONMENTS:
        latex = latex.replace(f"{{{environment}}}", f"{{{known}}}")
    try:
        drawn: str = convert(latex.strip(), display=display).replace("<mtable>", '<mtable displaystyle="true">')
    except Exception as error:
        raise ValueError(f"{page.file.src_uri}: an equation cannot be read: {error!r}: {latex}") from error
    drawn = FUNCTION.sub(r'<mo lspace="0.167em" rspace="0.167em">\1</mo>', drawn)
    return drawn.replace('<mo stretchy="false">&#x0007C;</mo>', '<mo stretchy="false" lspace="0" rspace="0">|</mo>')
