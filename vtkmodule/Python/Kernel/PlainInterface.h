#pragma once

#include <cstddef>
#include <cstdint>

// The functions that Python calls through `ctypes` (vtkmodule/Python/_kernel.py declares the same):
// no types of C++ or of Python, so that one library serves every version of Python.
//
// Answers  text of JSON, which the caller gives to pointfrontFree(): what was asked for, or
//          {"error": sentence, "cancelled": bool}. Null: the system gave no memory for it.
// Threads  a cloud and all functions may be used from any thread; a call runs on its caller's.

extern "C"
{
  /// Called from threads of the kernel, one at a time, some ten times a second; 0 ends the work.
  using PointFrontProgress = int (*)(const char* phase, double fraction);

  struct PointFrontCloud;

  /// Which points; a point must meet every condition that is there.
  struct PointFrontQuery
  {
    const double* box; ///< null, or lowest corner and highest corner
    const double* sphere; ///< null, or centre and radius
    const char* area; ///< null, or well-known text
    double lineDistance; ///< distance from the area's lines
    const std::uint8_t* classes;
    std::size_t classCount; ///< 0: all
    const char* where; ///< null, or a condition
    double spacing; ///< 0: all points
    const char* attributes; ///< names, each with a zero byte behind it, as many as follow
    std::size_t attributeCount;
    std::uint64_t memoryBytes; ///< memory of the nodes that are being read; 0: the usual
    std::uint64_t mostPoints; ///< more are an error
    std::uint32_t piece; ///< this share of the points
    std::uint32_t pieces; ///< number of pieces
  };

  /// An attribute of points that Python has, or the places of them.
  struct PointFrontArray
  {
    const char* name; ///< null: the places, three float64 each
    const void* data; ///< contiguous, in the byte order of the machine
    std::uint8_t type; ///< pointfront::ScalarType
    std::uint8_t components;
  };

  void pointfrontFree(void* memory);

  /// Answers the names of classes 0 to 255, "ground" ...
  char* pointfrontClassNames();

  /// A text: an address without what is secret in it, which this process opens as the address.
  char* pointfrontPublicForm(const char* address);
  /// Headers for servers, and addresses by their marks: the text of POINTFRONT_FAR
  /// (docs/user/remote.md). Answers null of JSON.
  char* pointfrontCredentials(const char* text);

  /// Answers what this process has had from servers so far: "requests", "bytes_fetched", "retries",
  /// "cache_hits", "cache_bytes".
  char* pointfrontTraffic();

  /// `cloud` gets the opened cloud, or null; `bounds` its lowest and highest corner. Answers
  /// "path", "points", "attributes", "computed" (those of them that are made while points are
  /// read), "classes" (pairs of number and name) and "deep" (whether "rgb" has values above 255).
  /// A 0 of `progress` ends it while it waits for a server.
  char* pointfrontOpen(
    const char* path, PointFrontCloud** cloud, double bounds[6], PointFrontProgress progress);
  void pointfrontClose(PointFrontCloud* cloud);

  /// Answers "points" and "columns": {"name", "type", "components", "address"} each, of memory that
  /// the caller gives to pointfrontFree(). The places have the name "", the numbers in the store
  /// are called "id". "warnings" are sentences; of several pieces the first has them.
  char* pointfrontPoints(
    const PointFrontCloud* cloud, const PointFrontQuery* query, PointFrontProgress progress);

  /// `request`  JSON of the keys in BuildRequest.cxx; each byte of its texts is a code point, so
  ///            that paths need not be UTF-8.
  /// `arrays`   instead of its "files": `points` points; the first array is their places.
  char* pointfrontBuild(const char* request, const PointFrontArray* arrays, std::size_t arrayCount,
    std::uint64_t points, PointFrontProgress progress);

  /// Indexes a LAS file. Answers "points" and "warnings".
  char* pointfrontIndex(const char* las, const char* side, int overwrite, std::uint32_t nodePoints,
    PointFrontProgress progress);
}
