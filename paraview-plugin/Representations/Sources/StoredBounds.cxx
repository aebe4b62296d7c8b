#include "StoredBounds.h"

#include "vtkObjectFactory.h"
#include "vtkPoints.h"

#include <algorithm>
#include <optional>

namespace pointfront
{
namespace
{

class BoundedPoints : public vtkPoints
{
public:
  static BoundedPoints* New() { VTK_STANDARD_NEW_BODY(BoundedPoints); }
  vtkTypeMacro(BoundedPoints, vtkPoints);

  void tell(const std::array<double, 6>& bounds) { told_ = bounds; }

  void ComputeBounds() override
  {
    if (told_)
    {
      std::copy(told_->begin(), told_->end(), this->Bounds);
    }
    else
    {
      this->Superclass::ComputeBounds();
    }
  }

private:
  std::optional<std::array<double, 6>> told_;
};

} // namespace

vtkSmartPointer<vtkPoints> withStoredBounds(vtkPoints* points, const std::array<double, 6>& bounds)
{
  const auto bounded = vtkSmartPointer<BoundedPoints>::New();
  bounded->SetData(points->GetData());
  bounded->tell(bounds);
  return bounded;
}

} // namespace pointfront
