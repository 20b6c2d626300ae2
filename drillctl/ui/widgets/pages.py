"""Blocks of lines, distributed to pages of a window. Rule: a block is broken only if no page can hold it."""

from collections.abc import Iterable, Sequence

from drillctl.ui.widgets.texts import Line, width_of

MARK_COLUMNS = len(" 2/3 Tab")  # that a line leaves free which may be the first of a page


def apart(blocks: Iterable[list[Line]]) -> list[list[Line]]:
    """Blocks with an empty line after each."""
    return [[*block, []] for block in blocks]


def numbered_pages(blocks: Sequence[list[Line]], columns: int, rows: int) -> list[list[Line]]:
    """Blocks on pages, each with its number where they are more than one."""
    pages = _paged(blocks, rows)
    if len(pages) == 1:
        return pages
    return [_numbered(page, f"{number}/{len(pages)} Tab", columns) for number, page in enumerate(pages, start=1)]


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
