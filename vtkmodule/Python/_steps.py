"""One step of `pointfront build --tiles`, as a worker of `pointfront cluster build` does it."""

import contextlib
import ctypes
import os
import pathlib
import shlex
import signal
import socket
import subprocess
import time

from . import _bucket
from ._errors import PointFrontError
from ._host import TOOL

POLL = 0.5  # seconds
LOGS = "work/logs"  # below the output's folder


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


def place(output, run):
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
        return _run_at(place(output, stop), step, arguments, working_folder, stop)
    except PointFrontError as problem:
        return str(problem)


def _run_at(where, step, arguments, working_folder, stop):
    where.prepare(step)
    command = [str(TOOL), *arguments, *where.options, "--only", step, "--progress", "none"]
    begin = time.time()
    with subprocess.Popen(command, cwd=working_folder, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=where.environment,
                          preexec_fn=_dies_with_its_worker) as process:
        said = None
        while said is None:
            try:
                said = process.communicate(timeout=POLL)[0].decode(errors="replace")
            except subprocess.TimeoutExpired:
                if where.stopped(stop):
                    process.terminate()
        status = process.returncode
    where.log(f"{step.replace(':', '-')}.log",
              f"{time.strftime('%Y-%m-%d %H:%M:%S', time.localtime(begin))} "
              f"{socket.gethostname()} {shlex.join(command)}\n{said}"
              f"status {status} after {time.time() - begin:.1f} s\n")
    logs = f"{where.address}/{LOGS}"
    if status < 0:
        raise RuntimeError(f"{step}: ended by {signal.Signals(-status).name}; see {logs}")
    if status == 0:
        if "was done before" not in said:
            where.publish(step)
        return None
    lines = [line for line in where.public(said).splitlines() if ": warning: " not in line]
    return lines[-1] if lines else f"{step}: ended with status {status}; see {logs}"
