"""Starts a program that shows a window, and looks whether it still runs after some seconds, as a
window that waits for its user does.

usage: run_window.py PROGRAM ARGUMENT...
"""

import subprocess
import sys

SECONDS = 3.0

with subprocess.Popen(sys.argv[1:], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                      text=True) as program:
    try:
        output, _ = program.communicate(timeout=SECONDS)
        sys.exit(f"it ended with status {program.returncode}: {output}")
    except subprocess.TimeoutExpired:
        program.kill()
        output, _ = program.communicate()
if output:
    sys.exit(f"it complained: {output}")
print("it waits for its user")
