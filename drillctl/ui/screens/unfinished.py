"""Jobs that were cut off, offered to be gone on with: at the start of the program, in Files, before a new start.

Rule: says first what will be drilled again, and asks before a job goes on elsewhere than it ran; nothing moves and
nothing is taken away but by a button of its own.
"""

from collections.abc import Callable
from pathlib import Path

from drillctl.language.words import _, ngettext, translated
from drillctl.ui.screens.shell import Shell
from drillctl.viewmodel.console import Console, Problems
from drillctl.viewmodel.jobs import Site, UnfinishedJob


def offer_unfinished(console: Console, shell: Shell) -> bool:
    """Offers to resume the jobs that were interrupted; False where there are none."""
    jobs = console.unfinished()
    if len(jobs) == 1:
        offer_job(jobs[0], console, shell)
    elif jobs:
        lines = [f"{Path(job.file).name}  {_counted(job)}  {job.machine}" for job in jobs]
        shell.choose(_("Interrupted jobs"), lines, lambda index: offer_job(jobs[index], console, shell))
    return bool(jobs)


def offer_job(job: UnfinishedJob, console: Console, shell: Shell, anew: Callable[[], object] | None = None) -> None:
    """Offers to resume a job or to give it up; with ``anew``, giving it up calls this to begin again."""

    def go_on(elsewhere: bool) -> None:
        shell.work(lambda watch: console.take_up(job.journal, elsewhere, watch), taken_up)

    def taken_up(problems: Problems) -> None:
        if problems := problems or console.go_on():
            shell.message(_("Refused"), [translated(problem) for problem in problems])
        else:
            shell.show("drilling")

    def go_on_where_it_ran() -> None:
        if question := elsewhere_question(job):
            shell.ask(question, lambda: go_on(elsewhere=True))
        else:
            go_on(elsewhere=False)

    def give_up() -> None:
        if problems := console.give_up(job.journal):
            shell.message(_("Refused"), [translated(problem) for problem in problems])
        elif anew is not None:
            anew()

    label = _("Abandon") if anew is None else _("Anew")
    shell.offer(_("Interrupted job"), job_lines(job), [(_("Go on"), go_on_where_it_ran), (label, give_up)])


def job_lines(job: UnfinishedJob) -> list[str]:
    """What the journal says, and what going on with it means."""
    lines = [f"{job.file}", _("on {machine}: {counted}").format(machine=job.machine, counted=_counted(job))]
    lines.append(site_words(job.ran))
    if job.torn:
        lines.append(_("The last line of its journal is torn, and left out."))
    if job.again:
        again = ", ".join(map(str, job.again))
        lines.append(_("Hole {numbers} was cut off in the middle; it will be drilled again.").format(numbers=again))
    if job.doubtful is not None:
        lines.append(_("Hole {number} may have been begun; it will be drilled again.").format(number=job.doubtful))
    for hole in job.suspect:
        lines.append(_("Look at hole {number}: a bit was found broken after it.").format(number=hole))
    if job.spotted:
        lines.append(_("Holes of the present tool may have their spot already; they are spotted again."))
    meaning = _("Going on initialises, takes the same working base and drills the rest. The board must lie as it lay.")
    return [*lines, "", meaning]


def elsewhere_question(job: UnfinishedJob) -> str:
    """The question before a job is resumed elsewhere than it ran; empty where it is not."""
    if job.ran == job.here:
        return ""
    sites = {"ran": site_words(job.ran), "here": site_words(job.here)}
    parts = [_("The job ran with {ran}. It would go on with {here}.").format(**sites)]
    if job.ran.real and not job.here.real:
        parts.append(_("What a simulated machine drills counts as drilled."))
    return " ".join([*parts, _("Go on all the same?")])


def site_words(site: Site) -> str:
    """The sentence that names port, pace and plant of a site."""
    form = _("port {port}, pace {pace}, plant {plant}")
    if site.real:
        form = _("port {port}, pace {pace}")
    elif site.seed:
        form = _("port {port}, pace {pace}, plant {plant}, seed {seed}")
    words = form.format(port=site.port, pace=site.pace, plant=site.plant, seed=site.seed)
    return _("{site}, converter {name}").format(site=words, name=site.converter) if site.converter else words


def _counted(job: UnfinishedJob) -> str:
    text = ngettext("{done} of {count} hole is drilled", "{done} of {count} holes are drilled", job.holes_total)
    return text.format(done=job.holes_done, count=job.holes_total)
