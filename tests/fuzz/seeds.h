// First inputs of the fuzzers.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace viewcell {

class Seeds {
 public:
  explicit Seeds(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// folder/fuzzer/name, where the fuzzer's folder is made.
  std::filesystem::path file(const std::string& fuzzer, const std::string& name) const;
  void add(const std::string& fuzzer, const std::string& name, std::string_view bytes) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace viewcell
