// When a view at rest that is being loaded is drawn: not with every node that arrives.

#include "MadeUpReader.h"
#include "RendererFront.h"
#include "TerrainPages.h"

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>

using namespace pointfront;
using pointfront::test::MadeUpReader;
using pointfront::test::Terrain;

namespace
{

constexpr double anHour = 3.6e6; // ms

std::shared_ptr<const Hierarchy> terrain(int levels)
{
  const Terrain made(levels);
  std::vector<Node> rows;
  for (NodeIndex n = 0; n < made.nodeCount(); ++n)
  {
    rows.push_back(made.row(n));
  }
  return std::make_shared<HierarchyTable>(rows, std::vector<NodeIndex>{ 0 }, Refinement::Add);
}

/// A view whose last drawing took `drawingMs` and has just ended; behind its root the nodes come
/// as the test lets them through.
struct LoadingView
{
  LoadingView()
    : reader(std::make_shared<MadeUpReader>())
    , table(terrain(3))
    , share(reader, table->nodeCount(), ResidencyOptions())
    , view(renderer, [] {})
  {
    view.Front = std::make_unique<ViewFront>(std::make_shared<HierarchyPiece>(table, 0, 1), share,
      schema, std::make_shared<WindowDemand>());
    const double s = Terrain::sizeMetres;
    view.Demand.view = View::perspective(
      { 0.5 * s, 0.5 * s, s }, { 0.5 * s, 0.51 * s, 0 }, { 0, 0, 1 }, 0.9, 1.0, 1e7, 800, 600);
    view.Demand.targetErrorPx = 0.01;
    reader->closeGate();
    reader->letThrough(1); // the root
    view.Front->update(view.Demand);
    reader->awaitReads(1); // the next
    while (view.Front->wantsUpdate())
    {
      view.Front->update(view.Demand);
    }
    drawn(anHour);
  }
  ~LoadingView() { reader->openGate(); }
  void drawn(double drawingMs)
  {
    view.NewFrame = false;
    view.Ahead = false;
    view.Due = false;
    view.DrawnAt = RendererFront::Clock::now();
    view.DrawingMs = drawingMs;
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
  vtkNew<vtkRenderer> renderer;
  RendererFront view;
};

TEST(Pauses, WhatArrivesWithinThePauseMovesTheFrontAndIsNotDrawn)
{
  LoadingView loading;
  EXPECT_FALSE(loading.view.NeedsRender()) << "nothing is new";
  EXPECT_FALSE(loading.view.Ahead);
  const std::size_t before = loading.view.Front->last().draw.size();
  loading.arrive();
  EXPECT_FALSE(loading.view.NeedsRender());
  EXPECT_TRUE(loading.view.Ahead);
  EXPECT_GT(loading.view.Front->last().draw.size(), before);
}

TEST(Pauses, AfterThePauseWhatArrivedIsDrawn)
{
  LoadingView loading;
  loading.arrive();
  EXPECT_FALSE(loading.view.NeedsRender());
  loading.view.DrawingMs = 0.0; // three times nothing has passed
  EXPECT_TRUE(loading.view.NeedsRender());
  loading.drawn(anHour);
  loading.view.DrawnAt -= std::chrono::minutes(179);
  loading.arrive();
  EXPECT_FALSE(loading.view.NeedsRender());
  loading.view.DrawnAt -= std::chrono::minutes(2); // three times the drawing
  EXPECT_TRUE(loading.view.NeedsRender());
  loading.view.DrawingMs = 1e9;
  EXPECT_TRUE(loading.view.NeedsRender()) << "once it is due it stays so until it is drawn";
  loading.drawn(1e9);
  EXPECT_FALSE(loading.view.NeedsRender());
}

TEST(Pauses, WhenAllIsThereThePauseEnds)
{
  LoadingView loading;
  loading.arriveAll();
  while (!loading.view.NeedsRender()) // the front may ask for more, which then comes at once
  {
    ASSERT_TRUE(loading.view.Front->expectsMore());
    loading.share.residency().waitUntilIdle();
  }
  EXPECT_TRUE(loading.view.Front->last().complete);
}

TEST(Pauses, NoneInMotionNorForACompleteRender)
{
  for (const bool interacting : { true, false })
  {
    LoadingView loading;
    loading.view.Demand.interacting = interacting;
    loading.view.Demand.complete = !interacting;
    loading.arrive();
    EXPECT_TRUE(loading.view.NeedsRender());
    EXPECT_FALSE(loading.view.Ahead) << "the frame moves the front itself";
  }
}

TEST(Pauses, WhatIsNotSeenIsNeverDue)
{
  LoadingView loading;
  loading.view.DrawingMs = 0.0;
  loading.view.Seen = false;
  loading.arrive();
  EXPECT_FALSE(loading.view.NeedsRender());
}

TEST(Pauses, WhatIsLeftToUploadIsDueAtOnce)
{
  LoadingView loading;
  loading.view.UploadsLeft = true;
  EXPECT_TRUE(loading.view.NeedsRender());
}

} // namespace
