"""Equations as MathML, which browsers draw themselves: nothing runs or is loaded when a page is read.

Documents write displayed equations as GitHub reads them, in a fence ``math`` or between ``$$``, with ``\\tag{…}`` for the number, and
those within a line between ``$``. LaTeX that cannot be read ends the build with its text.
"""

from __future__ import annotations

import html
import re
from typing import Any

from latex2mathml.converter import convert
from pymdownx.arithmatex import arithmatex_fenced_format

DISPLAYED = re.compile(r'<div class="arithmatex">\\\[(.*?)\\\]</div>', re.DOTALL)
INLINE = re.compile(r'<span class="arithmatex">\\\((.*?)\\\)</span>', re.DOTALL)
TAG = re.compile(r"\\tag\{([^}]*)\}")


def on_config(config: Any) -> Any:
    """Fences of the language ``math`` are equations."""
    fences = config.mdx_configs.setdefault("pymdownx.superfences", {}).setdefault("custom_fences", [])
    fences.append({"name": "math", "class": "arithmatex", "format": arithmatex_fenced_format(which="generic")})
    return config


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
    try:
        return convert(latex.strip(), display=display)
    except Exception as error:
        raise ValueError(f"{page.file.src_uri}: an equation cannot be read: {error!r}: {latex}") from error
