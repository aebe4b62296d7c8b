"""Progress of long calls: by a callable, or as tqdm's bar."""


class Watch:
    """Hands the progress of a VTK object on; keeps what the receiver raises.

    progress  None; a callable (phase, fraction) whose False ends the work; or True: a bar of tqdm
    """

    def __init__(self, algorithm, event, progress):
        self.raised = []
        self._bar = None
        self._phase = None
        if progress is None or progress is False:
            return
        if progress is True:
            from tqdm.auto import tqdm

            self._bar = tqdm(total=1.0, bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}")
            progress = self._advance

        def report(caller, _event):
            try:
                if progress(caller.GetProgressText() or "", caller.GetProgress()) is False:
                    caller.AbortExecuteOn()
            except BaseException as problem:  # VTK prints what an observer raises, and goes on
                self.raised.append(problem)
                caller.AbortExecuteOn()

        algorithm.AddObserver(event, report)

    def _advance(self, phase, fraction):
        self._bar.set_description_str(phase, refresh=False)
        self._bar.n = fraction
        self._bar.refresh()

    def end(self):
        """Raises what the receiver raised."""
        if self._bar is not None:
            self._bar.close()
        if self.raised:
            raise self.raised[0]
