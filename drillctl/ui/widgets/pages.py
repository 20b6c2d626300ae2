"""Blocks of lines, distributed to pages of a window. Rule: a block is broken only if no page can hold it."""

from collections.abc import Iterable, Sequence

from drillctl.ui.widgets.texts import Line, width_of


def apart(blocks: Iterable[list[Line]]) -> list[list[Line]]:
    """Blocks with an empty line after each."""
    return [[*block, []] for block in blocks]


def numbered_pages(blocks: Sequence[list[Line]], columns: int, rows: int) -> list[list[Line]]:
    """Blocks on pages, each with its number where they are more than one: at the right of its first line, or, where
    a first line has no room for it, in a line of its own on every page.
    """
    pages = _paged(blocks, rows)
    if len(pages) == 1:
        return pages
    if rows > 1 and any(width_of(page[0]) + len(_mark(pages, 1)) >= columns for page in pages):
        pages = [[[], *page] for page in _paged(blocks, rows - 1)]
    return [_numbered(page, _mark(pages, number), columns) for number, page in enumerate(pages, start=1)]


def _mark(pages: Sequence[list[Line]], number: int) -> str:
    return f"{number}/{len(pages)} Tab"


def _paged(blocks: Sequence[list[Line]], rows: int) -> list[list[Line]]:
    """Distributes blocks of lines to pages; a block is broken only if no page can hold it."""
    pages: list[list[Line]] = [[]]
    for block in blocks:
        if pages[-1] and len(pages[-1]) + len(block) > rows:
            pages.append([])
        for line in block:
            if len(pages[-1]) == max(rows, 1):
                pages.append([])
            pages[-1].append(line)
    return pages


def _numbered(page: list[Line], mark: str, columns: int) -> list[Line]:
    """The page with its number at the right of the first line."""
    gap = max(1, columns - len(mark) - width_of(page[0]))
    return [[*page[0], " " * gap, ("key", mark)], *page[1:]]
