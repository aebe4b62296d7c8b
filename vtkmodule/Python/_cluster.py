"""`pointfront cluster build`: a collection of tiles built by many processes, here or on a cluster.

`distributed` (Dask) schedules the steps of `pointfront build --tiles`; the tool does each of them.
So the bytes are those of that command, and what it has done is not done again.
"""

import argparse
import asyncio
import collections
import contextlib
import json
import logging
import os
import signal
import subprocess
import sys
import threading
import time
import uuid

from . import _bucket
from ._errors import PointFrontError
from ._host import TOOL
from ._steps import LOGS, POLL, place
from ._version import __version__

INTERRUPTED = 130  # an exit status
CONNECT = 20  # seconds until a scheduler that does not answer is given up
TRIES = 10  # workers that may die under a step
RETRIES = 2  # times a step is done again that a signal ended
# Dask watches each of its processes many times a second, for a dashboard that this command does not
# show: a tenth of two cores. A step takes seconds, in a process of its own.
QUIET = {"distributed.worker.profile.enabled": False,
         "distributed.admin.tick.interval": "500ms",
         "distributed.admin.system-monitor.interval": "10s"}


def parser():
    made = argparse.ArgumentParser(
        prog="pointfront cluster build", allow_abbrev=False,
        description="Builds a collection of tiles as `pointfront build --tiles` does, to the same "
                    "bytes, by many processes. Takes all options of `pointfront build`: --memory "
                    "and --threads hold for each process. The same command goes on where it was "
                    "stopped.")
    made.add_argument("-o", "--output", required=True, metavar="FOLDER|s3://BUCKET/PREFIX",
                      help="a folder that all workers see under this name, or a bucket")
    where = made.add_mutually_exclusive_group()
    where.add_argument("--local", type=int, metavar="N",
                       help="so many processes on this machine (one for two cores)")
    where.add_argument("--scheduler", metavar="ADDRESS",
                       help="a running scheduler, and its workers")
    made.add_argument("--progress", choices=("auto", "plain", "json", "none"), default="auto",
                      help="on stderr")
    made.add_argument("--json", action="store_true", help="print the report as one JSON object")
    return made


class StepFailed(PointFrontError):
    """A step ended with an error of its own: to run it again would end the same."""


class _Stopped(Exception):
    """The user asked to stop."""


def _shipped():
    """The function that workers call. It travels by value: neither the scheduler nor a worker has
    to import this package to read it, and a machine without it can say so.
    """
    def run(step, version, **rest):
        import socket

        advice = "each worker needs this PointFront in the Python that runs it"
        try:
            import pointfront
            from pointfront._steps import run_step
        except ImportError as problem:
            return f"{socket.gethostname()} cannot import PointFront ({problem}): {advice}"
        if pointfront.__version__ != version:
            return (f"{socket.gethostname()} has PointFront {pointfront.__version__}, and this is "
                    f"{version}: {advice}")
        return run_step(step, **rest)

    return run


class _Progress:
    """How far the steps of a phase are, on stderr."""

    def __init__(self, style):
        self.style = style if style != "auto" else "line" if sys.stderr.isatty() else "none"
        self.begin = time.monotonic()

    def show(self, phase, done, total, share):
        if self.style == "none":
            return
        seconds = time.monotonic() - self.begin
        left = seconds * (1 - share) / share if share > 0 else None
        if self.style == "json":
            text = json.dumps({"phase": phase, "done": done, "total": total, "fraction": share,
                               "seconds": seconds, "seconds_remaining": left})
        else:
            text = f"{100 * share:5.1f} %  {phase}: {done} of {total}"
            text += "" if left is None else f"  {left:.0f} s left"
        end = "\033[K" if self.style == "line" else "\n"
        start = "\r" if self.style == "line" else ""
        print(f"{start}{text}", end=end, file=sys.stderr, flush=True)

    def say(self, text):
        """A line that stays."""
        self.close()
        print(f"pointfront cluster build: {text}", file=sys.stderr, flush=True)

    def close(self):
        if self.style == "line":
            print("\r\033[K", end="", file=sys.stderr, flush=True)


class _Keeper(threading.Thread):
    """Replaces workers of this machine that died before they were up, which nobody else does. If
    none comes up for two minutes it gives up what the build waits for.
    """

    EVERY = 5.0  # seconds
    MOST = 24  # times without a worker

    def __init__(self, build, cluster, workers):
        super().__init__(daemon=True)
        self.build, self.cluster, self.workers = build, cluster, workers
        self.ended = threading.Event()

    def run(self):
        without = 0
        while not self.ended.wait(self.EVERY):
            with contextlib.suppress(Exception):
                alive = len(self.build.client.nthreads())
                without = 0 if alive else without + 1
                if alive < self.workers:
                    self.cluster.scale(self.workers)
                if without == self.MOST:
                    self.build.client.cancel(list(self.build.futures))


class _Lookout(threading.Thread):
    """Says when a scheduler has had no worker for a while, and when it has some again: jobs wait in
    a queue or have ended, and nothing else would tell.
    """

    AFTER = 30.0  # seconds

    def __init__(self, build, address):
        super().__init__(daemon=True)
        self.build, self.address = build, address
        self.ended = threading.Event()

    def run(self):
        last, told = time.monotonic(), False
        while not self.ended.wait(min(5.0, self.AFTER)):
            with contextlib.suppress(Exception):
                alive = len(self.build.client.nthreads())
                last = time.monotonic() if alive else last
                if told and alive:
                    told = False
                    self.build.progress.say(f"{self.address} has workers again: goes on")
                elif not told and time.monotonic() - last >= self.AFTER:
                    told = True
                    self.build.progress.say(
                        f"{self.address} has no worker: waits for one. Are its jobs queued, or "
                        "has their time ended?")


class ClusterBuild:
    """One build: its steps, and the client that has them run."""

    def __init__(self, client, arguments, output, progress):
        self.client = client
        self.output = output
        self.arguments = arguments
        self.progress = progress
        self.futures = {}  # those that are waited for: the step of each
        self.run_name = f"stop-{uuid.uuid4().hex}"
        self.stop = f"work/{self.run_name}"  # a file of the output
        self.place = place(output, self.stop)
        self.done = False

    def work(self, name):
        with open(self.place.path(f"work/{name}"), encoding="utf-8") as file:
            return json.load(file)

    def here(self, step, *options):
        """A short step, on this machine: stdout."""
        self.place.prepare(step)
        done = subprocess.run([str(TOOL), *self.arguments, *self.place.options, "--only", step,
                               "--progress", "none", *options], env=self.place.environment,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        said = self.place.public(done.stderr).splitlines()
        for line in said:
            if ": warning: " in line:
                print(line, file=sys.stderr)
        if done.returncode != 0:
            lines = [line for line in said if ": warning: " not in line]
            prefix = "pointfront build: "
            raise StepFailed((lines or [f"{step} failed"])[-1].removeprefix(prefix))
        self.place.publish(step)
        return self.place.public(done.stdout)

    def submit(self, phase, steps):
        """Gives steps to the scheduler: their futures."""
        # Keys of one group, whose tasks the scheduler keeps until a worker is free. Others it deals
        # out at once, without knowing how long they take, and some workers end long before others.
        keys = [f"('{phase}-{self.run_name}', {len(self.futures) + number})"
                for number in range(len(steps))]
        futures = self.client.map(
            _shipped(), steps, key=keys, retries=RETRIES, pure=False, version=__version__,
            arguments=self.arguments, output=self.output, working_folder=os.getcwd(),
            stop=self.stop)
        self.futures |= zip(futures, steps)
        return futures

    def everywhere(self, phase, weights, share_before, share):
        """Runs steps, given with their weights, on the workers. Those that fail do not keep others
        from running; StepFailed names them at the end.
        """
        from distributed import KilledWorker, as_completed

        total = sum(weights.values()) or 1
        deaths = collections.Counter()
        self.futures = {}
        self.submit(phase, list(weights))
        done, faults = 0, []
        self.progress.show(phase, 0, len(weights), share_before)
        weight = 0
        completed = as_completed(list(self.futures))
        for future in completed:
            step = self.futures[future]
            try:
                fault = future.result()
            except KilledWorker as problem:
                # A scheduler that runs gives up sooner than the one of this machine.
                deaths[step] += problem.allowed_failures + 1
                if deaths[step] < TRIES:
                    completed.update(self.submit(phase, [step]))
                    future.release()
                    continue
                fault = (f"{deaths[step]} workers died while they did it: was their job too small "
                         "for it, or its time too short?")
            # A signal ended the tool, or the scheduler gave up.
            except (Exception, asyncio.CancelledError) as problem:
                fault = f"{type(problem).__name__}: {' '.join(str(problem).split())}"
            if fault:
                faults.append(f"{step}: {fault.removeprefix('pointfront build: ')}")
            future.release()
            done += 1
            weight += weights[step]
            self.progress.show(phase, done, len(weights), share_before + share * weight / total)
        if faults:
            some = "; ".join(faults[:5])
            raise StepFailed(f"{len(faults)} of {len(weights)} {phase} failed (the others are "
                             f"done; the same command goes on; logs: {self.output}/{LOGS}): "
                             f"{some}")

    def run(self):
        """All steps; the tool's report as text."""
        self.here("plan")
        inputs = self.work("plan.json")["inputs"]
        surveys = {f"survey:{number}": 1 for number in range(len(inputs))}
        self.everywhere("surveys", surveys, 0, 0.25)
        self.here("settle")
        tiles = self.work("tiles.json")["tiles"]
        # The largest first: no worker is left alone with one at the end.
        tiles.sort(key=lambda tile: -tile[2])
        self.everywhere("tiles", {f"tile:{x}_{y}": points for x, y, points in tiles}, 0.25, 0.73)
        report = self.here("collect", "--json")
        self.done = True
        return report


SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextlib.contextmanager
def signals_held_back():
    """Signals that come meanwhile act behind it: Dask's start is not made to be interrupted."""
    came = []
    before = [signal.signal(number, lambda *_: came.append(True)) for number in SIGNALS]
    try:
        yield
    finally:
        for number, handler in zip(SIGNALS, before):
            signal.signal(number, handler)
        if came:
            raise KeyboardInterrupt


def _client(chosen):
    """A client of the scheduler, or of processes here, and what to close after it."""
    try:
        import dask
        import distributed
    except ImportError as problem:
        raise PointFrontError(
            f"needs the package distributed ({problem}): pip install 'pointfront[cluster]'; on "
            "Debian python3-distributed") from problem
    # A worker that dies is no fault of its step.
    dask.config.set({"distributed.scheduler.allowed-failures": TRIES,
                     "distributed.scheduler.worker-saturation": 1.0})  # no step waits at a worker
    if chosen.scheduler:
        logging.disable(logging.ERROR)  # Dask logs tracebacks of what main() says in one line
        return distributed.Client(chosen.scheduler, timeout=CONNECT), None
    dask.config.set(QUIET)
    workers = chosen.local or max(1, (os.cpu_count() or 2) // 2)
    cluster = distributed.LocalCluster(
        n_workers=workers, threads_per_worker=1, processes=True, memory_limit=0,
        dashboard_address="127.0.0.1:0", scheduler_kwargs={"dashboard": False}, silence_logs=50)
    return distributed.Client(cluster), cluster


def _output(output, rest):
    """The output as workers name it, and the tool's options for it."""
    if not _bucket.is_bucket(output):
        folder = os.path.abspath(output)
        return folder, ["-o", folder]
    address = _bucket.Bucket(output).output
    words = " ".join(rest).replace("=", " ")
    if "--decode once" in words:
        raise PointFrontError(
            "--decode once keeps decoded points in the output's folder, and a bucket is none; "
            "leave --decode out, or build into a folder")
    return address, [] if "--decode" in words.split() else ["--decode", "twice"]


def _per_process(chosen, rest):
    """Options of each process, so that those of one machine do not take more than one build."""
    if chosen.scheduler:
        return []
    workers = chosen.local or max(1, (os.cpu_count() or 2) // 2)
    words = [word.split("=")[0] for word in rest]
    options = []
    if "--threads" not in words:
        options += ["--threads", str(max(1, (os.cpu_count() or 1) // workers))]
    if "--memory" not in words:
        memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
        options += ["--memory", f"{memory // 2 // workers // 2 ** 20}M"]
    return options


def _tell(report, as_json):
    if as_json:
        print(report, end="")
        return
    told = json.loads(report)
    out = ", ".join(f"{count} {reason}" for reason, count in told["points_rejected"].items())
    skipped = told.get("inputs_skipped", [])
    if skipped:
        named = ", ".join(f"{one['path']} ({one['why']})" for one in skipped)
        out += f"{'; ' if out else ''}skipped {len(skipped)} inputs: {named}"
    print(f"{told['collection']}: {told['points_stored']} points in {told['tiles']} tiles"
          f"{'; left out: ' + out if out else ''}")


def main(arguments):
    """Builds; the exit status."""
    if arguments[:1] != ["build"]:
        print("usage: pointfront cluster build IN... -o FOLDER|s3://BUCKET/PREFIX "
              "[--local N | --scheduler ADDRESS] [OPTIONS of pointfront build]", file=sys.stderr)
        return 0 if arguments[:1] in (["-h"], ["--help"]) else 2
    chosen, rest = parser().parse_known_args(arguments[1:])
    rest = [word for word in rest if word != "--tiles"]
    if "://" in chosen.output and not _bucket.is_bucket(chosen.output):
        print(f"pointfront cluster build: --output: '{chosen.output}' is an address: tiles are "
              "built into a folder or into s3://BUCKET/PREFIX", file=sys.stderr)
        return 2
    progress = _Progress(chosen.progress)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    build, client, cluster, watch = None, None, None, None
    try:
        output, options = _output(chosen.output, rest)
        with contextlib.nullcontext() if chosen.scheduler else signals_held_back():
            client, cluster = _client(chosen)
        tool = ["build", *rest, *_per_process(chosen, rest), *options, "--tiles"]
        build = ClusterBuild(client, tool, output, progress)
        watch = (_Lookout(build, chosen.scheduler) if cluster is None
                 else _Keeper(build, cluster, len(cluster.workers)))
        watch.start()
        report = build.run()
        _ignore_signals()  # all is done
        progress.close()
        _tell(report, chosen.json)
        return 0
    except KeyboardInterrupt:
        progress.close()
        print("pointfront cluster build: cancelled; the same command goes on", file=sys.stderr)
        return INTERRUPTED
    except (PointFrontError, OSError, ValueError) as problem:
        progress.close()
        if build is not None and chosen.scheduler and client.status != "running":
            problem = (f"the scheduler {chosen.scheduler} went away. What is done stays: start it "
                       "and its workers again, and the same command goes on")
        print(f"pointfront cluster build: {problem}", file=sys.stderr)
        return 1
    finally:
        if watch is not None:
            watch.ended.set()
        _end(build, client, cluster)


def _ignore_signals():
    for number in SIGNALS:
        signal.signal(number, signal.SIG_IGN)


def _end(build, client, cluster):
    """Ends what still runs, here and on the workers."""
    _ignore_signals()
    where = build.place if build and not build.done else None
    with contextlib.suppress(Exception):
        if where:
            where.stop(build.stop)
            time.sleep(2 * POLL if cluster is None else 0)
    with contextlib.suppress(Exception):
        if client:
            client.close(timeout=5)
    with contextlib.suppress(Exception):
        if cluster:
            cluster.close(timeout=5)
    with contextlib.suppress(Exception):
        if where:
            where.stop(build.stop, wanted=False)
