#include "BuiltStore.h"
#include "TestBuildClouds.h"

#include "vtkPointFrontReader.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <set>
#include <string>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// A store whose attributes are the same everywhere but those named.
std::string activeScalars(const std::set<std::string>& varying)
{
  AttributeSchema schema;
  schema.add({ "intensity", ScalarType::UInt16, 1 });
  schema.add({ "classification", ScalarType::UInt8, 1 });
  schema.add({ "rgb", ScalarType::UInt16, 3 });
  auto cloud = std::make_unique<CloudSource>("scalars", schema, millimetres({ 0.0, 0.0, 0.0 }));
  for (int i = 0; i < 1000; ++i)
  {
    const auto value = [&](const char* name) { return varying.count(name) ? i % 7 : 0; };
    cloud->addPosition(glm::dvec3(i % 30, i / 30, 0.001 * i));
    cloud->addValue(0, static_cast<std::uint16_t>(value("intensity")));
    cloud->addValue(1, static_cast<std::uint8_t>(value("classification")));
    const auto green = static_cast<std::uint16_t>(value("rgb"));
    cloud->addValue(2, std::array<std::uint16_t, 3>{ 0, green, 0 });
  }
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(builtStore("scalars", std::move(cloud)).c_str());
  reader->Update();
  vtkPointData* attributes = reader->GetOutput()->GetPointData();
  auto* elevation = attributes->GetArray("elevation");
  EXPECT_NEAR(elevation->GetRange()[0], 0.0, 1e-6);
  EXPECT_NEAR(elevation->GetRange()[1], 0.999, 1e-6);
  return attributes->GetScalars()->GetName();
}

TEST(Reader, TheActiveScalarsShowSomething)
{
  EXPECT_EQ(activeScalars({ "rgb", "classification", "intensity" }), "rgb");
  EXPECT_EQ(activeScalars({ "classification", "intensity" }), "classification");
  EXPECT_EQ(activeScalars({ "intensity" }), "intensity");
  EXPECT_EQ(activeScalars({}), "elevation");
}

} // namespace
