// When a view at rest that is being loaded is drawn: not with every node that arrives.

#include "LoadingView.h"

#include <gtest/gtest.h>

using namespace pointfront;
using pointfront::test::LoadingView;

namespace
{

constexpr double anHour = 3.6e6; // ms

/// A view whose last frame took an hour and ended at `drawnAt`.
class StoreViews : public testing::Test
{
protected:
  StoreViews() { draw(); }
  void draw()
  {
    view_.drew(0, drawnAt_);
    view_.took(1, 0, anHour);
  }
  /// Whether a frame is due so many minutes after the last one.
  bool dueAfter(int minutes, bool begun = false)
  {
    return view_.needsFrame(begun, drawnAt_ + std::chrono::minutes(minutes));
  }

  StoreView view_;
  LoadingView loading_{ view_ };
  const StoreView::Clock::time_point drawnAt_ = StoreView::Clock::now();
};

TEST_F(StoreViews, AreDueUntilTheyAreDrawnFirst)
{
  StoreView view;
  const LoadingView loading(view);
  EXPECT_TRUE(view.needsFrame());
  view.drew(0);
  EXPECT_FALSE(view.needsFrame());
}

TEST_F(StoreViews, WhatArrivesWithinThePauseMovesTheFrontAndIsNotDrawn)
{
  EXPECT_FALSE(dueAfter(1)) << "nothing is new";
  EXPECT_FALSE(view_.isAhead());
  const std::size_t before = view_.front()->last().draw.size();
  loading_.arrive();
  EXPECT_FALSE(dueAfter(1));
  EXPECT_TRUE(view_.isAhead());
  EXPECT_TRUE(view_.hasNews());
  EXPECT_GT(view_.front()->last().draw.size(), before);
}

TEST_F(StoreViews, AfterThePauseWhatArrivedIsDrawn)
{
  loading_.arrive();
  EXPECT_FALSE(dueAfter(179));
  EXPECT_TRUE(dueAfter(181)) << "three times the frame";
  EXPECT_TRUE(dueAfter(1)) << "once it is due it stays so until it is drawn";
  draw();
  EXPECT_FALSE(dueAfter(1));
}

TEST_F(StoreViews, WhenAllIsThereThePauseEnds)
{
  loading_.arriveAll();
  while (!dueAfter(1)) // the front may ask for more, which then comes at once
  {
    ASSERT_TRUE(view_.front()->expectsMore());
    loading_.share.residency().waitUntilIdle();
  }
  EXPECT_TRUE(view_.front()->last().complete);
}

TEST_F(StoreViews, ThereIsNoPauseInMotionNorForACompleteFrameNorInOneThatBegan)
{
  for (const char* why : { "interacting", "complete", "begun" })
  {
    SCOPED_TRACE(why);
    FrameRequest request = view_.request();
    request.interacting = why == std::string("interacting");
    // A complete update would wait for the gate, so that this one is aborted at once.
    request.complete = why == std::string("complete");
    request.aborted = [] { return true; };
    view_.update(request);
    draw();
    loading_.arrive();
    EXPECT_TRUE(dueAfter(1, why == std::string("begun")));
    EXPECT_FALSE(view_.isAhead()) << "the frame moves the front itself";
  }
}

} // namespace
