#include "RegionPlanes.h"

#include "vtkAbstractTransform.h"
#include "vtkBox.h"
#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPlanes.h"
#include "vtkPoints.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <algorithm>
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

const double* frustumOf(vtkSelection* selection)
{
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* const node = selection->GetNode(i);
    auto* const corners = vtkDoubleArray::SafeDownCast(node->GetSelectionList());
    if (node->GetContentType() == vtkSelectionNode::FRUSTUM && corners &&
      corners->GetNumberOfValues() == 32)
    {
      return corners->GetPointer(0);
    }
  }
  return nullptr;
}

vtkSmartPointer<vtkPlanes> planesOf(const double frustum[32])
{
  Vector middle = { 0.0, 0.0, 0.0 };
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      middle[axis] += frustum[4 * corner + axis] / 8.0;
    }
  }
  vtkNew<vtkPoints> origins;
  origins->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> normals;
  normals->SetNumberOfComponents(3);
  // A corner's number has a bit for far, one for up and one for right.
  for (std::size_t side = 0; side < 6; ++side)
  {
    const std::size_t bit = std::size_t(1) << side / 2;
    std::array<const double*, 4> corners;
    for (std::size_t corner = 0, found = 0; corner < 8; ++corner)
    {
      if (((corner & bit) != 0) == (side % 2 == 1))
      {
        corners[found++] = frustum + 4 * corner;
      }
    }
    // Its diagonals are long where the near end is tiny, too.
    Vector diagonals[2];
    Vector normal;
    vtkMath::Subtract(corners[3], corners[0], diagonals[0].data());
    vtkMath::Subtract(corners[2], corners[1], diagonals[1].data());
    vtkMath::Cross(diagonals[0].data(), diagonals[1].data(), normal.data());
    vtkMath::Normalize(normal.data());
    const auto outwards = [&](const double* corner)
    {
      Vector from;
      vtkMath::Subtract(corner, middle.data(), from.data());
      return vtkMath::Dot(from.data(), normal.data());
    };
    if (outwards(corners[0]) < 0.0)
    {
      vtkMath::MultiplyScalar(normal.data(), -1.0);
    }
    origins->InsertNextPoint(*std::max_element(corners.begin(), corners.end(),
      [&](const double* a, const double* b) { return outwards(a) < outwards(b); }));
    normals->InsertNextTuple(normal.data());
  }
  return planesOf(origins, normals);
}

bool mayOverlap(const double frustum[32], vtkPlanes* sides, const double box[6])
{
  for (int side = 0; side < sides->GetNumberOfPlanes(); ++side)
  {
    double normal[3];
    double origin[3];
    sides->GetNormals()->GetTuple(side, normal);
    sides->GetPoints()->GetPoint(side, origin);
    double nearest = 0.0; // how far the box's innermost corner lies outside
    for (int axis = 0; axis < 3; ++axis)
    {
      nearest += normal[axis] * (box[2 * axis + (normal[axis] < 0.0 ? 1 : 0)] - origin[axis]);
    }
    if (nearest > 0.0)
    {
      return false;
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    bool below = true;
    bool above = true;
    for (std::size_t corner = 0; corner < 8; ++corner)
    {
      below = below && frustum[4 * corner + axis] < box[2 * axis];
      above = above && frustum[4 * corner + axis] > box[2 * axis + 1];
    }
    if (below || above)
    {
      return false;
    }
  }
  return true;
}

} // namespace pointfront
