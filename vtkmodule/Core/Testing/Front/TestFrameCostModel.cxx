#include "pointfront/Front/FrameCostModel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace pointfront
{
namespace
{

/// A made-up machine: 8 ms a million points, 0.05 ms a move, 3 ms for an empty frame, some noise.
struct Machine
{
  double perPoint = 8e-6;
  double perMove = 0.05;
  double empty = 3.0;
  double noise = 0.3;
  std::mt19937 random{ 7 };

  double frameMs(std::uint64_t points, std::uint32_t moves)
  {
    std::uniform_real_distribution<double> jitter(-noise, noise);
    return perPoint * double(points) + perMove * moves + empty + jitter(random);
  }
  void run(FrameCostModel& model, int frames)
  {
    for (int f = 0; f < frames; ++f)
    {
      const std::uint64_t points = 200000 + random() % 3000000;
      const auto moves = static_cast<std::uint32_t>(random() % 200);
      model.record(points, moves, frameMs(points, moves));
    }
  }
};

} // namespace

TEST(FrameCostModel, KnowsSomethingBeforeTheFirstFrame)
{
  const FrameCostModel model;
  EXPECT_GT(model.predictMs(1000000, 0), model.predictMs(1000, 0));
  EXPECT_GT(model.pointsFor(33.0, 1000), 100000u);
  EXPECT_LT(model.pointsFor(33.0, 1000), 100000000u);
  EXPECT_EQ(model.pointsFor(0.1, 1000), 1000u);
}

TEST(FrameCostModel, LearnsTheMachine)
{
  FrameCostModel model;
  Machine machine;
  machine.run(model, 100);
  EXPECT_NEAR(model.predictMs(1000000, 0), 11.0, 0.5);
  EXPECT_NEAR(model.predictMs(2000000, 100), 24.0, 0.7);
  EXPECT_NEAR(model.movesFor(16.0, 1000000), 100.0, 15.0);
}

TEST(FrameCostModel, OneSpikeHardlyMatters)
{
  FrameCostModel model;
  Machine machine;
  machine.run(model, 60);
  const double before = model.predictMs(1500000, 50);
  model.record(1500000, 50, 900.0); // the first upload of a big node
  EXPECT_NEAR(model.predictMs(1500000, 50), before, 0.1 * before);
  machine.run(model, 10);
  EXPECT_NEAR(model.predictMs(1500000, 50), before, 0.05 * before);
}

TEST(FrameCostModel, ASpikeInTheFirstFrameIsForgotten)
{
  FrameCostModel model;
  Machine machine;
  model.record(500000, 64, 1200.0); // shaders are compiled
  machine.run(model, 80);
  EXPECT_NEAR(model.predictMs(1000000, 0), 11.0, 2.0);
}

TEST(FrameCostModel, FollowsAMachineThatBecomesSlower)
{
  FrameCostModel model;
  Machine machine;
  machine.run(model, 100);
  machine.perPoint *= 5.0; // the window was made larger
  machine.run(model, 60);
  EXPECT_NEAR(model.predictMs(1000000, 0), 43.0, 4.0);
}

TEST(FrameCostModel, AStillCameraDoesNotMakeItAbsurd)
{
  FrameCostModel model;
  for (int f = 0; f < 500; ++f)
  {
    model.record(1000000, 0, 25.0);
  }
  EXPECT_NEAR(model.predictMs(1000000, 0), 25.0, 0.5);
  // Most of it is the points': twice as many do not come for free, and none do not cost all.
  EXPECT_GT(model.predictMs(2000000, 0), 32.0);
  EXPECT_LT(model.predictMs(0, 0), 18.0);
  EXPECT_GT(model.pointsFor(50.0, 0), 1500000u);
  EXPECT_LT(model.pointsFor(12.5, 0), 1000000u);
}

TEST(FrameCostModel, APointCountThatFollowsItSettlesAndStays)
{
  // A slow drag: what is drawn is what the model allows, with nothing else that varies.
  for (const double noise : { 0.01, 0.1 })
  {
    for (const double empty : { 1.0, 30.0 })
    {
      FrameCostModel model;
      Machine machine;
      machine.perPoint = 150e-6; // software rendering
      machine.empty = empty;
      std::uint64_t points = 2000;
      for (int frame = 0; frame < 400; ++frame)
      {
        machine.noise = noise * machine.perPoint * double(points);
        model.record(points, 0, machine.frameMs(points, 0));
        points = model.pointsFor(66.7, 1000);
        if (frame > 20)
        {
          machine.noise = 0.0;
          ASSERT_NEAR(machine.frameMs(points, 0), 66.7, (0.12 + 2.0 * noise) * 66.7) << frame;
        }
      }
    }
  }
}

TEST(FrameCostModel, AMachineThatIsFreeAgainHasMorePointsWithinTenFrames)
{
  // Long frames at rest while another program ran, then motion without it.
  FrameCostModel model;
  Machine machine;
  machine.perPoint = 450e-6;
  for (int frame = 0; frame < 60; ++frame)
  {
    model.record(1300000, 0, machine.frameMs(1300000, 0));
  }
  machine.perPoint = 100e-6;
  std::uint64_t points = model.pointsFor(66.7, 1000);
  for (int frame = 0; frame < 10; ++frame)
  {
    model.record(points, 0, machine.frameMs(points, 0));
    points = model.pointsFor(66.7, 1000);
  }
  EXPECT_NEAR(machine.frameMs(points, 0), 66.7, 7.0);
}

TEST(FrameCostModel, AMachineThatBecomesSlowerHasFewerPointsWithinTenFrames)
{
  FrameCostModel model;
  Machine machine;
  std::uint64_t points = 2000;
  for (int frame = 0; frame < 300; ++frame)
  {
    if (frame == 200)
    {
      machine.perPoint *= 4.0; // larger points
    }
    model.record(points, 0, machine.frameMs(points, 0));
    points = model.pointsFor(33.0, 1000);
    if (frame > 210)
    {
      EXPECT_NEAR(machine.frameMs(points, 0), 33.0, 4.0);
    }
  }
}

TEST(FrameCostModel, OneSpikeCostsFewPointsAndNotForLong)
{
  FrameCostModel model;
  Machine machine;
  std::uint64_t points = 2000;
  double ideal = 0.0;
  for (int frame = 0; frame < 120; ++frame)
  {
    model.record(points, 0, frame == 100 ? 400.0 : machine.frameMs(points, 0));
    points = model.pointsFor(33.0, 1000);
    ideal = 30.0 / machine.perPoint;
    if (frame >= 100)
    {
      EXPECT_GT(double(points), 0.7 * ideal) << frame;
    }
  }
  EXPECT_GT(double(points), 0.85 * ideal); // within a tenth of the time nothing changes
}

TEST(FrameCostModel, CostsAreNeverNegative)
{
  FrameCostModel model;
  std::mt19937 random(3);
  for (int f = 0; f < 300; ++f)
  {
    // The more points, the faster: nonsense, as when the camera moves into a sparse place.
    const std::uint64_t points = random() % 2000000;
    model.record(points, static_cast<std::uint32_t>(random() % 300), 40.0 - 1e-5 * double(points));
    EXPECT_GE(model.predictMs(1000000, 0), model.predictMs(0, 0));
    EXPECT_GE(model.predictMs(0, 100), model.predictMs(0, 0));
    EXPECT_GE(model.predictMs(0, 0), 0.0);
    const std::uint32_t moves = model.movesFor(16.0, points);
    EXPECT_TRUE(moves >= 8 && moves <= 4096);
  }
}

TEST(FrameCostModel, TimesThatAreNoTimesAreLeftOut)
{
  FrameCostModel model;
  const double before = model.predictMs(123456, 7);
  model.record(123456, 7, 0.0);
  model.record(123456, 7, -5.0);
  model.record(123456, 7, std::numeric_limits<double>::quiet_NaN());
  model.record(123456, 7, std::numeric_limits<double>::infinity());
  EXPECT_EQ(model.predictMs(123456, 7), before);
}

} // namespace pointfront
