"""Builds a store from point files, with normals and heights: build.py STORE.pfront POINTS...

Prints how it gets on. The store is whole or not there; Ctrl-C ends the build and leaves nothing.
"""

import signal
import sys

import pointfront


def main(store, files):
    builder = pointfront.vtkPointFrontBuilder()
    for name in files:
        builder.AddFileName(name)
    builder.SetOutputFileName(store)
    builder.OverwriteOn()  # a store of that name is replaced when the new one is whole
    builder.SetMemoryLimit(2 << 30)
    builder.SetLayersToClass()
    builder.SetNormalsToPCA()
    builder.SetNormalsNeighbors(8)
    builder.CurvatureOn()
    builder.HeightAboveGroundOn()

    def show(builder, event):
        seconds = builder.GetSecondsRemaining()
        left = f"{seconds:.0f} s left" if seconds >= 0.0 else ""
        print(f"{builder.GetProgress():5.0%} {builder.GetProgressText()} {left}")

    builder.AddObserver("ProgressEvent", show)
    # A preview can be opened, and a view of it will follow, as soon as this says so.
    builder.AddObserver(
        "UpdateDataEvent", lambda b, event: print("look at", b.GetPreviewFileName()))
    signal.signal(signal.SIGINT, lambda number, frame: builder.AbortExecuteOn())

    if not builder.Write():  # VTK has said why
        sys.exit(1)
    print(f"{builder.GetNumberOfPointsStored()} points in {builder.GetNumberOfNodes()} nodes")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
