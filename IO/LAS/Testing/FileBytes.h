#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace pointfront::test
{

/// A file's bytes in memory, to be broken on purpose and written elsewhere.
class FileBytes
{
public:
  /// Reads the whole file; a failure is a test failure.
  explicit FileBytes(const std::string& path);

  std::size_t size() const { return bytes_.size(); }
  void resize(std::size_t size) { bytes_.resize(size); }
  std::uint8_t& operator[](std::size_t at) { return bytes_.at(at); }

  template <typename T>
  void put(std::size_t at, T value)
  {
    std::memcpy(&bytes_.at(at + sizeof(T) - 1) - (sizeof(T) - 1), &value, sizeof(T));
  }
  template <typename T>
  T get(std::size_t at) const
  {
    T value;
    std::memcpy(&value, &bytes_.at(at + sizeof(T) - 1) - (sizeof(T) - 1), sizeof(T));
    return value;
  }
  /// Place of that text; a failure is a test failure and gives 0.
  std::size_t find(const std::string& text) const;

  /// Writes the bytes to a file of this name under the test's own folder; gives its path.
  std::string write(const std::string& name) const;

private:
  std::vector<std::uint8_t> bytes_;
};

/// A folder for this process alone.
std::string outputFolder();

} // namespace pointfront::test
