"""Progress of long calls: by a callable, or as tqdm's bar."""

import contextlib
import signal
import threading

import numpy

from ._errors import PointFrontError


def ends(answer):
    """Whether a receiver of progress ends the work: by Python's or NumPy's False, and by nothing
    else, as print() and write() answer, too.
    """
    return isinstance(answer, (bool, numpy.bool_)) and not answer


class Watch:
    """Hands the progress of a VTK object on; raises what the receiver raised when the work is over.

        with Watch(algorithm, vtkCommand.ProgressEvent, progress):
            algorithm.Update()

    progress  None; a callable (phase, fraction) whose False ends the work; or True: a bar of tqdm

    A KeyboardInterrupt ends the work, too, and is raised when it is over.
    """

    def __init__(self, algorithm, event, progress):
        self._algorithm = algorithm
        self._event = event
        self._raised = []
        self._bar = None
        self._before = None  # the handler of SIGINT that was there
        self._observer = None
        if progress is True:
            self._bar = _bar()
            progress = _advancing(self._bar)
        # Python sees an interrupt only when it is called: without a receiver, to do nothing.
        self._progress = progress if progress not in (None, False) else _say_nothing

    def _report(self, caller, _event):
        try:
            if ends(self._progress(caller.GetProgressText() or "", caller.GetProgress())):
                caller.AbortExecuteOn()
        except BaseException as problem:  # VTK prints what an observer raises, and goes on
            self._stop(problem)

    def _stop(self, problem):
        self._raised.append(problem)
        self._algorithm.AbortExecuteOn()

    def __enter__(self):
        self._observer = self._algorithm.AddObserver(self._event, self._report)
        # A KeyboardInterrupt that strikes inside an observer ends the process: VTK's rule.
        if (threading.current_thread() is threading.main_thread()
                and signal.getsignal(signal.SIGINT) is signal.default_int_handler):
            self._before = signal.signal(
                signal.SIGINT, lambda *_: self._stop(KeyboardInterrupt()))
        return self

    def __exit__(self, kind, *_):
        # Else a circle of references would keep the result.
        self._algorithm.RemoveObserver(self._observer)
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)
        if self._bar is not None:
            self._bar.close()
        if kind is None and self._raised:
            raise self._raised[0]


@contextlib.contextmanager
def receiving(progress):
    """A callable (phase, fraction) for what a caller gives as `progress`; a bar ends with it."""
    if progress is not True:
        yield progress if progress not in (None, False) else _say_nothing
        return
    bar = _bar()
    try:
        yield _advancing(bar)
    finally:
        bar.close()


def _advancing(bar):
    def advance(phase, fraction):
        if phase:
            bar.set_description_str(phase, refresh=False)
        bar.n = fraction
        bar.refresh()

    return advance


def _say_nothing(_phase, _fraction):
    return True


def _bar():
    try:
        from tqdm.auto import tqdm
    except ImportError:
        raise PointFrontError("progress=True draws a bar with Python's package tqdm, which is not "
                              "there: pip install tqdm, or pass a callable") from None
    return tqdm(total=1.0, bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}")
