"""The job's journal: what was to be drilled, where it ran, and each hole begun and done as execution confirmed it.

    chain.py    a line as bytes: JSON, sealed by a checksum over itself and all lines before it
    account.py  what the lines say, each in its place
    reader.py   a journal file read; the job of its first line compared with the one made now
    writer.py   a journal that is open: locked, on the disk before what a line announces may happen
    folder.py   a folder of journals: the jobs in it that were cut off, and giving one of them up

Rule: append-only and never rewritten. A torn last line (the power went) is left out and said; any other damage, and a
line out of its place, refuses the journal.
"""

from drillctl.jobs.journal.account import Account, Head
from drillctl.jobs.journal.chain import JournalError
from drillctl.jobs.journal.reader import check_same, head_of, read_journal
from drillctl.jobs.journal.writer import Journal

__all__ = ["Account", "Head", "Journal", "JournalError", "check_same", "head_of", "read_journal"]
