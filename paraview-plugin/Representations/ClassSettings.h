#pragma once

#include <map>
#include <set>
#include <string>

class vtkPointFrontMapper;

namespace pointfront
{

/// Settings of a representation for the object classes of a store, by their names. Names that the
/// store does not have are kept and count for nothing.
/// Threads  a value.
struct ClassSettings
{
  std::set<std::string> hidden;
  std::map<std::string, double> errorFactors; ///< vtkPointFrontMapper::SetClassTargetErrorFactor
  std::map<std::string, double> budgetShares; ///< vtkPointFrontMapper::SetClassBudgetShare

  /// Tells the mapper for each class of its store.
  void apply(vtkPointFrontMapper& mapper) const;
};

} // namespace pointfront
