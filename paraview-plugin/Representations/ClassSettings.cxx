#include "ClassSettings.h"

#include "vtkPointFrontMapper.h"
#include "vtkPointFrontStore.h"

namespace pointfront
{
namespace
{

double valueOf(const std::map<std::string, double>& values, const char* name, double otherwise)
{
  const auto found = values.find(name);
  return found != values.end() ? found->second : otherwise;
}

} // namespace

void ClassSettings::apply(vtkPointFrontMapper& mapper) const
{
  vtkPointFrontStore* const store = mapper.GetStore();
  for (int i = 0; store && i < store->GetNumberOfObjectClasses(); ++i)
  {
    const char* name = store->GetObjectClassName(i);
    const int number = store->GetObjectClassNumber(i);
    mapper.SetClassVisibility(number, hidden.count(name) == 0);
    mapper.SetClassTargetErrorFactor(number, valueOf(errorFactors, name, 1.0));
    mapper.SetClassBudgetShare(number, valueOf(budgetShares, name, 0.0));
  }
}

} // namespace pointfront
