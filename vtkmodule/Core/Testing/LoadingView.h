#pragma once

#include "MadeUpReader.h"
#include "TerrainPages.h"

#include "pointfront/Plan/StoreView.h"

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

namespace pointfront::test
{

/// A view that has been drawn and is being loaded: behind its root the nodes come as the test lets
/// them through.
struct LoadingView
{
  explicit LoadingView(StoreView& storeView)
    : reader(std::make_shared<MadeUpReader>())
    , table(terrain(3))
    , share(reader, table->nodeCount(), ResidencyOptions())
    , view(storeView)
  {
    view.open(std::make_unique<ViewFront>(std::make_shared<HierarchyPiece>(table, 0, 1), share,
      schema, std::make_shared<WindowDemand>()));
    const double s = Terrain::sizeMetres;
    FrameRequest request;
    request.view = View::perspective(
      { 0.5 * s, 0.5 * s, s }, { 0.5 * s, 0.51 * s, 0 }, { 0, 0, 1 }, 0.9, 1.0, 1e7, 800, 600);
    request.targetErrorPx = 0.01;
    reader->closeGate();
    reader->letThrough(1); // the root
    view.update(request);
    reader->awaitReads(1); // the next
    while (view.front()->wantsUpdate())
    {
      view.update(request);
    }
  }
  ~LoadingView()
  {
    reader->openGate();
    view.open(nullptr); // it refers to what this owns
  }
  LoadingView(const LoadingView&) = delete;
  LoadingView& operator=(const LoadingView&) = delete;

  static std::shared_ptr<const Hierarchy> terrain(int levels)
  {
    const Terrain made(levels);
    std::vector<Node> rows;
    for (NodeIndex n = 0; n < made.nodeCount(); ++n)
    {
      rows.push_back(made.row(n));
    }
    return std::make_shared<HierarchyTable>(rows, std::vector<NodeIndex>{ 0 }, Refinement::Add);
  }
  /// One more node arrives, and the next is being read.
  void arrive()
  {
    const std::uint64_t before = share.residency().arrivals();
    reader->letThrough(1);
    while (share.residency().arrivals() == before)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    reader->awaitReads(1);
  }
  void arriveAll()
  {
    reader->openGate();
    share.residency().waitUntilIdle();
  }

  std::shared_ptr<MadeUpReader> reader;
  std::shared_ptr<const Hierarchy> table;
  AttributeSchema schema;
  ResidencyShare share;
  StoreView& view;
};

} // namespace pointfront::test
