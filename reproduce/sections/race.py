"""Section 6.2: how long each method takes to beta .85."""

from dataclasses import dataclass

from reproduce import bodies, formulas, paper
from reproduce.report import Html, number

TARGET = 0.85


@dataclass
class Entrant:
    label: str
    method: str
    parameters: dict
    limited: str = ""  # which limit of sweeps holds for a method that has no target

    def body(self, start, **more):
        return {"points": start, "method": self.method, **self.parameters, **more}


@dataclass
class Run:
    label: str
    body: dict
    result: dict
    seconds: list
    note: str


def entrants():
    return [
        Entrant("opt-beta, fast", "opt-beta", {"beta": TARGET, "randomness": "fast"}),
        Entrant("opt-beta, gentle", "opt-beta", {"beta": TARGET, "randomness": "gentle"}),
        Entrant("opt-beta-local", "opt-beta-local", {"beta": TARGET}),
        Entrant("cvt, accelerated", "cvt", {"variant": "accelerated"}, "accelerated"),
        Entrant("cvt, Lloyd", "cvt", {"variant": "lloyd"}, "lloyd"),
        Entrant("distmesh", "distmesh", {}, "distmesh"),
        Entrant("far-point", "far-point", {}, "far-point"),
    ]


def push_pull(radii_of):
    """Its targets are radii: those that opt-beta came to, which together are beta .85. Nothing if it has none."""
    if not radii_of["rho"]:
        return None
    rho = formulas.floor_to(radii_of["rho"], 4)
    return Entrant("push-pull", "push-pull", {"rho": rho, "coverage": formulas.floor_to(TARGET * rho, 4)})


def timed(context, label, body, note=""):
    seconds = []
    for _ in range(context.sizes.race_repeats):
        result, taken = context.client.timed("optimize", body)
        seconds.append(taken)
    return Run(label, body, result, seconds, note)


def compete(context, entrant, start):
    """Those without a target get as many sweeps as take them there, as an untimed run finds out."""
    if not entrant.limited:
        return timed(context, entrant.label, entrant.body(start))
    most = context.sizes.race_sweeps[entrant.limited]
    result, _ = context.client.timed("optimize", entrant.body(start, max_sweeps=most))
    needed = formulas.first_sweep_at(result["history"], TARGET)
    if needed is None:
        return timed(context, entrant.label, entrant.body(start, max_sweeps=most),
                     f"did not get there in {result['sweeps']} "
                     f"sweeps{', after which it came to rest' if result['sweeps'] < most else ''}")
    return timed(context, entrant.label, entrant.body(start, max_sweeps=needed),
                 f"has no target; asked for just the {needed} sweeps that it takes")


def fill(context, section):
    sizes = context.sizes
    start = bodies.mps(sizes.race_points)
    generate = [context.client.timed("generate", start["generate"])[1] for _ in range(sizes.race_repeats)]
    runs = []
    for entrant in entrants():
        runs.append(compete(context, entrant, start))
        follower = push_pull(runs[0].result) if entrant.label == "opt-beta, fast" else None
        if follower:
            runs.append(timed(context, "push-pull", follower.body(start),
                              f"its targets are radii: rho as opt-beta's here, coverage {TARGET:g} rho"))
    alone = formulas.median_and_range(generate)[0]
    runs = ordered(runs)
    section.text(f"{sizes.race_points} points from the same MPS set to global beta {TARGET}. Seconds are those of "
                 f"{sizes.race_repeats} synchronous requests as seen by the client, from sending to the last byte "
                 "of the points as JSON: sampling, optimizing, measuring and proving, and writing. Sampling is "
                 "also given alone, and what remains without it.")
    section.table("Median seconds (smallest to largest), fastest first; those that missed the target last.",
                  ["method", "#seconds", "#without sampling", "#sweeps", "#beta", "#beta_upper", "reached", "remark"],
                  [["MPS input alone", seconds_text(generate), *[number(None)] * 4, "", ""],
                   *(row(run, alone) for run in runs)])
    section.text(f"The paper's seconds: {paper.NOT_AVAILABLE}; they would be of another machine.")
    section.table("For comparison, not the paper's: other programs as measured for this project: "
                  "CPU seconds of one thread (those above are wall-clock seconds of all cores), 10,000 points from MPS, "
                  "sampling not included.",
                  ["program", "asked for", "#seconds", "#beta"],
                  [[program, asked, f"{seconds:g}", number(beta)] for program, asked, seconds, beta in paper.PEERS])
    section.text("Where it differs: methods without a target get the sweeps they need, known from a run before, so "
                 "nothing is spent on finding out whether they are there; this favors them. A sweep of opt-beta or "
                 "push-pull visits only points near a violation. The smallest seconds are mostly sampling, proving "
                 "and writing.", "differs")
    findings(section, runs)
    section.requests(bodies.curl("/v1/generate", start["generate"]),
                     *(bodies.curl("/v1/optimize", run.body) for run in runs))


def ordered(runs):
    """Fastest first, and last those that are not there."""
    return sorted(runs, key=lambda run: (not there(run), formulas.median_and_range(run.seconds)[0]))


def seconds_text(seconds):
    median, low, high = formulas.median_and_range(seconds)
    return f"{number(median)} ({number(low)}\u2013{number(high)})"


def there(run):
    """By proof, whatever the method was asked for."""
    upper = run.result["beta_upper"]
    return upper is not None and upper <= TARGET


def row(run, alone):
    ok = '<span class="holds">yes</span>' if there(run) else '<span class="fails">no</span>'
    return [run.label, seconds_text(run.seconds), number(max(0, formulas.median_and_range(run.seconds)[0] - alone)),
            str(run.result["sweeps"]), number(run.result["beta"], 4), number(run.result["beta_upper"], 4), Html(ok),
            run.note]


def findings(section, runs):
    missed = [f"{run.label} ({number(run.result['beta'])})" for run in runs if not there(run)]
    text = "; ".join(f"{run.label} {number(formulas.median_and_range(run.seconds)[0])} s"
                     for run in runs if there(run))
    section.finding(f"time to beta {TARGET}", paper.NOT_AVAILABLE,
                    text + (f"; not there: {', '.join(missed)}" if missed else ""), "no comparison")
