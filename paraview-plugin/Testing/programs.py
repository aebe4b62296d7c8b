"""Starts ParaView's programs and ours, and ends what is left of them."""

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
# Seconds for all programs of a run together: below the test's own limit, to be ended here. A night
# of random tests (docs/developer/random-tests.md) takes as long as it takes.
LIMIT = 850 if int(os.environ.get("POINTFRONT_RANDOM_COUNT", "40")) <= 40 else 100000


def tool(*arguments):
    command = [os.environ["POINTFRONT_TOOL"], *arguments]
    done = subprocess.run(command, check=True, timeout=LIMIT, stdout=subprocess.PIPE, text=True)
    return done.stdout


class Programs:
    """The programs of a run, each in a process group of its own, all ended when the run ends."""

    def __init__(self):
        self.deadline = time.time() + LIMIT
        self.running = []
        # The user's settings stay out, none are left behind, and none of an earlier run are found.
        self.home = os.path.abspath("home")
        shutil.rmtree(self.home, ignore_errors=True)
        os.makedirs(self.home, mode=0o700)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for program in self.running:
            if program.poll() is None:
                os.killpg(program.pid, signal.SIGTERM)
        for program in self.running:
            try:
                program.wait(10)
            except subprocess.TimeoutExpired:
                os.killpg(program.pid, signal.SIGKILL)
                program.wait()

    def start(self, *command, output=None):
        environment = dict(os.environ)
        environment["PYTHONPATH"] = os.pathsep.join([os.environ["POINTFRONT_PVPYTHONPATH"], HERE])
        environment["PYTHONUNBUFFERED"] = "1"  # lines come in their order
        for name in ("HOME", "XDG_CONFIG_HOME", "XDG_RUNTIME_DIR"):
            environment[name] = self.home
        program = subprocess.Popen(command, env=environment, start_new_session=True, stdout=output,
                                   stderr=subprocess.STDOUT if output else None)
        self.running.append(program)
        return program

    def finish(self, program):
        status = program.wait(max(1.0, self.deadline - time.time()))
        if status != 0:
            raise AssertionError("%s ended with %d" % (os.path.basename(program.args[0]), status))

    def run(self, *command):
        self.finish(self.start(*command))

    def told(self, log, *command):
        """Runs a program; gives what it said, and prints it however the program ended."""
        with open(log, "w") as output:
            program = self.start(*command, output=output)
        try:
            self.finish(program)
        finally:
            with open(log) as file:
                said = file.read()
            print(said)
        return said

    def by_mouse(self, name):
        """Returns what NAME.json says after ParaView's application ran NAME.py and NAME.xml."""
        script = os.path.join(HERE, name)
        self.run(os.environ["POINTFRONT_PARAVIEW"], "--dr", "--script=%s.py" % script,
                 "--test-script=%s.xml" % script, "--exit")
        with open(name + ".json") as file:
            found = json.load(file)
        print(found)
        return found


def mpi(ranks, program, *arguments):
    # One machine, no network: shared memory between the ranks, no remote shell. A waiting rank
    # yields its core, and sleeps where it does (idle_ranks.cxx).
    return [os.environ["POINTFRONT_MPIEXEC"], "--allow-run-as-root", "--oversubscribe",
            "--mca", "btl", "self,vader", "--mca", "plm_rsh_agent", "false",
            "--mca", "mpi_yield_when_idle", "1",
            "-x", "LD_PRELOAD=" + os.environ["POINTFRONT_IDLE_RANKS"],
            "-np", str(ranks), program, *arguments]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def with_server(programs, client):
    """Runs a client of a server with two ranks: the command that client() makes of the port."""
    port = free_port()
    with open("server.log", "w") as log:
        running = programs.start(
            *mpi(2, os.environ["POINTFRONT_PVSERVER"], "--server-port=%d" % port), output=log)
        # A probing connection would be taken for the client, so wait for what the server says.
        while "Accepting connection" not in open("server.log").read():
            if running.poll() is not None or time.time() > programs.deadline:
                raise AssertionError("pvserver does not start:\n" + open("server.log").read())
            time.sleep(0.1)
        programs.run(*client(port))
        programs.finish(running)  # a server ends with its client


def python_client(script, *arguments):
    """For with_server()."""
    return lambda port: [sys.executable, os.path.join(HERE, script), str(port), *arguments]
