#include "RegionPlanes.h"

#include "vtkAbstractTransform.h"
#include "vtkBox.h"
#include "vtkDoubleArray.h"
#include "vtkExtractSelectedFrustum.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPlanes.h"
#include "vtkPoints.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <array>
#include <cstddef>

namespace pointfront
{
namespace
{

using Vector = std::array<double, 3>;

vtkSmartPointer<vtkPlanes> planesOf(vtkPoints* origins, vtkDoubleArray* normals)
{
  auto planes = vtkSmartPointer<vtkPlanes>::New();
  planes->SetPoints(origins);
  planes->SetNormals(normals);
  return planes;
}

} // namespace

vtkSmartPointer<vtkPlanes> planesOf(vtkBox* box)
{
  // An implicit function's transform leads from the world to where its bounds are.
  vtkAbstractTransform* const turned = box->GetTransform();
  const auto toWorld = [&](const Vector& place)
  {
    Vector world = place;
    turned ? turned->GetInverse()->TransformPoint(place.data(), world.data()) : void();
    return world;
  };
  double bounds[6];
  box->GetBounds(bounds);
  vtkNew<vtkPoints> origins;
  origins->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> normals;
  normals->SetNumberOfComponents(3);
  const Vector middle = toWorld({ 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
    0.5 * (bounds[4] + bounds[5]) });
  for (std::size_t side = 0; side < 6; ++side)
  {
    // Three corners of the side: where it is, and two edges.
    const std::size_t axis = side / 2;
    Vector corner = { bounds[0], bounds[2], bounds[4] };
    corner[axis] = bounds[side];
    std::array<Vector, 2> along = { corner, corner };
    for (std::size_t k = 0; k < 2; ++k)
    {
      const std::size_t other = (axis + 1 + k) % 3;
      along[k][other] = bounds[2 * other + 1];
    }
    const Vector origin = toWorld(corner);
    Vector normal;
    Vector edges[2];
    Vector inward;
    for (std::size_t k = 0; k < 2; ++k)
    {
      vtkMath::Subtract(toWorld(along[k]).data(), origin.data(), edges[k].data());
    }
    vtkMath::Cross(edges[0].data(), edges[1].data(), normal.data());
    vtkMath::Normalize(normal.data());
    vtkMath::Subtract(middle.data(), origin.data(), inward.data());
    vtkMath::MultiplyScalar(
      normal.data(), vtkMath::Dot(normal.data(), inward.data()) > 0.0 ? -1.0 : 1.0);
    origins->InsertNextPoint(origin.data());
    normals->InsertNextTuple(normal.data());
  }
  return planesOf(origins, normals);
}

vtkSmartPointer<vtkPlanes> planesOf(vtkPlane* plane)
{
  vtkNew<vtkPoints> origins;
  origins->SetDataTypeToDouble();
  origins->InsertNextPoint(plane->GetOrigin());
  vtkNew<vtkDoubleArray> normals;
  normals->SetNumberOfComponents(3);
  normals->InsertNextTuple(plane->GetNormal());
  return planesOf(origins, normals);
}

vtkSmartPointer<vtkPlanes> planesOf(vtkSelection* selection)
{
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* const node = selection->GetNode(i);
    auto* const corners = vtkDoubleArray::SafeDownCast(node->GetSelectionList());
    if (node->GetContentType() == vtkSelectionNode::FRUSTUM && corners &&
      corners->GetNumberOfValues() == 32)
    {
      vtkNew<vtkExtractSelectedFrustum> frustum;
      frustum->CreateFrustum(corners->GetPointer(0));
      return frustum->GetFrustum();
    }
  }
  return nullptr;
}

} // namespace pointfront
