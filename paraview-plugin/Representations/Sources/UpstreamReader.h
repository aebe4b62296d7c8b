#pragma once

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"

namespace pointfront
{

/// The reader whose output arrives at a connection as it is, or null. A filter between them ends
/// the search: its output has other points than the store, or other values. What ParaView puts
/// behind every source does not count.
inline vtkPointFrontReader* upstreamReader(vtkAlgorithm* producer)
{
  while (producer && producer->IsA("vtkPVPostFilter") && producer->GetNumberOfInputPorts() > 0 &&
    producer->GetNumberOfInputConnections(0) > 0)
  {
    producer = producer->GetInputConnection(0, 0)->GetProducer();
  }
  return vtkPointFrontReader::SafeDownCast(producer);
}

/// The same for input port 0 of an algorithm.
inline vtkPointFrontReader* upstreamReaderOf(vtkAlgorithm* consumer)
{
  return consumer->GetNumberOfInputConnections(0) > 0
    ? upstreamReader(consumer->GetInputConnection(0, 0)->GetProducer())
    : nullptr;
}

/// Whether a reader's store is one that a build shows meanwhile. The view goes on to later versions
/// of it, in which points have other ids.
inline bool isPreview(vtkPointFrontReader* reader)
{
  return reader && reader->GetStore() && reader->GetStore()->IsPreview();
}

/// Why previews are refused.
inline const char* previewRefusal()
{
  return "the store is being built, and its preview has a part of the points only: wait for the "
         "end "
         "of the build";
}

} // namespace pointfront
