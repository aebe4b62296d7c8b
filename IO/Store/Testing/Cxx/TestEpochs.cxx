#include "BuiltStore.h"
#include "TestBuildClouds.h"

#include "pointfront/Collection/CollectionWriter.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"

#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <gtest/gtest.h>

#include <array>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

TileRequest tileOf(const std::string& name, std::size_t count, const char* epoch)
{
  auto cloud = std::make_unique<CloudSource>(name, AttributeSchema(), millimetres());
  Random random(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    cloud->addPosition({ 10.0 * random.uniform(), 10.0 * random.uniform(), random.uniform() });
  }
  TileRequest request{ builtStore(name, std::move(cloud), nodesOf(500)) };
  request.epoch = epoch;
  return request;
}

TEST(Epochs, OfACollectionAreTimeSteps)
{
  const std::string city = ::testing::TempDir() + "epochs.pfcollection";
  std::remove(city.c_str());
  const auto made = createCollection(city,
    { tileOf("epoch_a", 2000, "2019"), tileOf("epoch_b", 3000, "2024-07"),
      tileOf("epoch_c", 1500, "2019") },
    {});
  ASSERT_TRUE(made) << made.error().what;
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(city.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 6500); // those of all epochs
  vtkInformation* info = reader->GetOutputInformation(0);
  ASSERT_EQ(info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 2);
  EXPECT_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS())[0], 2019.0);
  EXPECT_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE())[1], 2024.5);
  const std::array<std::array<double, 3>, 5> asked = { { { 2024.5, 3000, 2024.5 },
    { 2019, 3500, 2019 }, { 2023, 3500, 2019 }, { 0, 3500, 2019 }, { 3000, 3000, 2024.5 } } };
  for (const auto& [time, points, step] : asked)
  {
    reader->UpdateTimeStep(time);
    EXPECT_EQ(static_cast<double>(reader->GetOutput()->GetNumberOfPoints()), points) << time;
    EXPECT_EQ(reader->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), step);
    EXPECT_EQ(
      vtkPointFrontStore::GetStoreName(reader->GetOutput()), reader->GetStore()->GetFileName());
  }

  reader->SetFileName((city + "#epoch=2019").c_str());
  reader->Update();
  EXPECT_FALSE(info->Has(vtkStreamingDemandDrivenPipeline::TIME_STEPS()));
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 3500);
  EXPECT_EQ(vtkPointFrontReader::CanReadFile((city + "#epoch=2019").c_str()), 1);
}

} // namespace
