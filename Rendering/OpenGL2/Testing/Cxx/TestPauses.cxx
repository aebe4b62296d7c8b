// A renderer adds these rules to the rhythm of a view (Core's StoreViews).

#include "LoadingView.h"
#include "RendererFront.h"

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <gtest/gtest.h>

using namespace pointfront;
using pointfront::test::LoadingView;

namespace
{

TEST(Pauses, WhatIsNotSeenIsNeverDue)
{
  vtkNew<vtkRenderer> renderer;
  RendererFront front(renderer, nullptr, [] {});
  LoadingView loading(front.View);
  front.NewFrame = false;
  front.View.drew(0);
  loading.arrive();
  EXPECT_TRUE(front.NeedsRender());
  front.Seen = false;
  EXPECT_FALSE(front.NeedsRender());
}

TEST(Pauses, WhatIsLeftToUploadIsDueAtOnce)
{
  vtkNew<vtkRenderer> renderer;
  RendererFront front(renderer, nullptr, [] {});
  const LoadingView loading(front.View);
  front.NewFrame = false;
  front.View.drew(0);
  EXPECT_FALSE(front.NeedsRender());
  front.UploadsLeft = true;
  EXPECT_TRUE(front.NeedsRender());
}

TEST(Pauses, AFrameThatBeganDoesNotPause)
{
  vtkNew<vtkRenderer> renderer;
  RendererFront front(renderer, nullptr, [] {});
  LoadingView loading(front.View);
  front.View.drew(0);
  front.View.took(1, 0, 3.6e6); // an hour, ms
  front.NewFrame = false;
  loading.arrive();
  EXPECT_FALSE(front.NeedsRender());
  front.View.drew(0);
  front.NewFrame = true;
  loading.arrive();
  EXPECT_TRUE(front.NeedsRender());
}

} // namespace
