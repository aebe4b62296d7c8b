"""`pointfront cluster build`: a collection of tiles built by many processes, here or on a cluster.

`distributed` (Dask) schedules the steps of `pointfront build --tiles`; the tool does each of them.
So the bytes are those of that command, and what it has done is not done again.
"""

import argparse
import asyncio
import contextlib
import ctypes
import json
import logging
import os
import pathlib
import shlex
import signal
import socket
import subprocess
import sys
import threading
import time
import uuid

from . import _bucket
from ._errors import PointFrontError
from ._host import TOOL

INTERRUPTED = 130  # an exit status
TRIES = 10  # workers that may die under a step
RETRIES = 2  # times a step is done again that a signal ended
POLL = 0.5  # seconds
LOGS = "work/logs"  # below the output's folder


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


def _dies_with_its_worker():
    """In the tool's process, before it begins: who kills a worker kills what it runs."""
    with contextlib.suppress(OSError, AttributeError):
        set_death_signal = 1
        ctypes.CDLL(None).prctl(set_death_signal, signal.SIGKILL)


class _Folder:
    """An output that all workers see under one name: steps are done in it."""

    options, environment = (), None

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.address = str(folder)

    def prepare(self, step):
        """Nothing: what the step needs is there."""

    publish = prepare

    def public(self, text):
        return text

    def path(self, name):
        return self.folder / name

    def log(self, name, text):
        logs = self.path(LOGS)
        logs.mkdir(parents=True, exist_ok=True)
        with open(logs / name, "a", encoding="utf-8") as log:
            log.write(text)

    def stop(self, mark, wanted=True):
        """Ends the steps of a run, or takes the word back."""
        if not wanted:
            self.path(mark).unlink()
        elif self.path(mark).parent.is_dir():
            self.path(mark).touch()

    def stopped(self, mark):
        return self.path(mark).exists()


def _place(output, run):
    return _bucket.Workplace.of(output, run) if _bucket.is_bucket(output) else _Folder(output)


def run_step(step, arguments, output, working_folder, stop):
    """Runs one step of the tool, on whichever machine a worker is; gives the error's text, or None.

    `output` is a folder or a bucket's address. `stop` is the name of a file there: when it appears,
    the step is ended. What the tool says goes to work/logs. RuntimeError: a signal ended the tool
    (no memory, for one).
    """
    if not os.path.isdir(working_folder):
        return f"{socket.gethostname()} has no folder {working_folder}: all workers need the same"
    try:
        return _run_at(_place(output, stop), step, arguments, working_folder, stop)
    except PointFrontError as problem:
        return str(problem)


def _run_at(place, step, arguments, working_folder, stop):
    place.prepare(step)
    command = [str(TOOL), *arguments, *place.options, "--only", step, "--progress", "none"]
    begin = time.time()
    with subprocess.Popen(command, cwd=working_folder, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=place.environment,
                          preexec_fn=_dies_with_its_worker) as process:
        said = None
        while said is None:
            try:
                said = process.communicate(timeout=POLL)[0].decode(errors="replace")
            except subprocess.TimeoutExpired:
                if place.stopped(stop):
                    process.terminate()
        status = process.returncode
    place.log(f"{step.replace(':', '-')}.log",
              f"{time.strftime('%Y-%m-%d %H:%M:%S', time.localtime(begin))} "
              f"{socket.gethostname()} {shlex.join(command)}\n{said}"
              f"status {status} after {time.time() - begin:.1f} s\n")
    logs = f"{place.address}/{LOGS}"
    if status < 0:
        raise RuntimeError(f"{step}: ended by {signal.Signals(-status).name}; see {logs}")
    if status == 0:
        if "was done before" not in said:
            place.publish(step)
        return None
    lines = [line for line in place.public(said).splitlines() if ": warning: " not in line]
    return lines[-1] if lines else f"{step}: ended with status {status}; see {logs}"


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
                alive = len(self.build.client.scheduler_info()["workers"])
                without = 0 if alive else without + 1
                if alive < self.workers:
                    self.cluster.scale(self.workers)
                if without == self.MOST:
                    self.build.client.cancel(list(self.build.futures))


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
        self.place = _place(output, self.stop)
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

    def everywhere(self, phase, weights, share_before, share):
        """Runs steps, given with their weights, on the workers. Those that fail do not keep others
        from running; StepFailed names them at the end.
        """
        from distributed import as_completed

        total = sum(weights.values()) or 1
        # Keys of one group, whose tasks the scheduler keeps until a worker is free. Others it deals
        # out at once, without knowing how long they take, and some workers end long before others.
        keys = [f"('{phase}-{self.run_name}', {number})" for number in range(len(weights))]
        futures = self.futures = dict(zip(self.client.map(
            run_step, list(weights), key=keys, retries=RETRIES, pure=False,
            arguments=self.arguments, output=self.output, working_folder=os.getcwd(),
            stop=self.stop), weights))
        done, faults = 0, []
        self.progress.show(phase, 0, len(weights), share_before)
        weight = 0
        for future in as_completed(list(futures)):
            step = futures[future]
            try:
                fault = future.result()
            # A signal ended the tool, or the scheduler gave up.
            except (Exception, asyncio.CancelledError) as problem:
                fault = f"{type(problem).__name__}: {problem}"
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
        return distributed.Client(chosen.scheduler, timeout=20), None
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
    build, client, cluster, keeper = None, None, None, None
    try:
        output, options = _output(chosen.output, rest)
        with contextlib.nullcontext() if chosen.scheduler else signals_held_back():
            client, cluster = _client(chosen)
        tool = ["build", *rest, *_per_process(chosen, rest), *options, "--tiles"]
        build = ClusterBuild(client, tool, output, progress)
        if cluster is not None:
            keeper = _Keeper(build, cluster, len(cluster.workers))
            keeper.start()
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
        if keeper is not None:
            keeper.ended.set()
        _end(build, client, cluster)


def _ignore_signals():
    for number in SIGNALS:
        signal.signal(number, signal.SIG_IGN)


def _end(build, client, cluster):
    """Ends what still runs, here and on the workers."""
    _ignore_signals()
    place = build.place if build and not build.done else None
    with contextlib.suppress(Exception):
        if place:
            place.stop(build.stop)
            time.sleep(2 * POLL if cluster is None else 0)
    with contextlib.suppress(Exception):
        if client:
            client.close(timeout=5)
    with contextlib.suppress(Exception):
        if cluster:
            cluster.close(timeout=5)
    with contextlib.suppress(Exception):
        if place:
            place.stop(build.stop, wanted=False)
