#include "BuiltStore.h"
#include "TestBuildClouds.h"

#include "vtkPointFrontReader.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <memory>
#include <string>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// Three kinds of points: 90 % of them in a hundredth of the area, 9 % elsewhere, and 1 % of
/// another class, which has a tree of its own if the store has layers.
std::string unevenStore(const std::string& name, bool layers)
{
  AttributeSchema schema;
  schema.add({ "classification", ScalarType::UInt8, 1 });
  auto cloud = std::make_unique<CloudSource>(name, schema, millimetres({ 0.0, 0.0, 0.0 }));
  Random random(5);
  for (int i = 0; i < 100000; ++i)
  {
    const double side = i % 100 < 90 ? 10.0 : 100.0;
    cloud->addPosition(
      glm::dvec3(side * random.uniform(), side * random.uniform(), random.uniform()));
    cloud->addValue(0, static_cast<std::uint8_t>(i % 100 == 99 ? 5 : 2));
  }
  BuildOptions options = nodesOf(1000);
  options.layering = layers ? Layering::ObjectClass : Layering::None;
  return builtStore(name, std::move(cloud), options);
}

TEST(Reader, TheOverviewHasItsShareOfEverything)
{
  for (const bool layers : { false, true })
  {
    vtkNew<vtkPointFrontReader> reader;
    reader->SetFileName(unevenStore(layers ? "layered" : "uneven", layers).c_str());
    for (const vtkIdType points : { 5000, 20000 })
    {
      reader->SetOverviewPoints(points);
      reader->Update();
      const vtkIdType count = reader->GetOutput()->GetNumberOfPoints();
      EXPECT_NEAR(static_cast<double>(count), static_cast<double>(points), 10.0);
      auto* classes = reader->GetOutput()->GetPointData()->GetArray("classification");
      int dense = 0;
      int rare = 0;
      for (vtkIdType i = 0; i < count; ++i)
      {
        const double* p = reader->GetOutput()->GetPoint(i);
        dense += p[0] < 10.0 && p[1] < 10.0 ? 1 : 0;
        rare += classes->GetTuple1(i) == 5.0 ? 1 : 0;
      }
      EXPECT_NEAR(static_cast<double>(dense) / static_cast<double>(count), 0.901, 0.02);
      EXPECT_NEAR(
        static_cast<double>(rare) / static_cast<double>(count), 0.01, layers ? 0.001 : 0.005);
    }
  }
}

} // namespace
