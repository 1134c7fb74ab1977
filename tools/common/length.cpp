#include "common/length.h"

#include <cstdlib>

namespace viewcell {
namespace {

bool has_percent(const std::string& word) {
  return !word.empty() && word.back() == '%';
}

}  // namespace

Check length_within(double lo, double hi) {
  const Check number = within(lo, hi);
  return {[number](const std::string& word) {
            return number.find_fault(has_percent(word) ? word.substr(0, word.size() - 1) : word);
          },
          number.shown + " or PERCENT%"};
}

Length parse_length(const std::string& word) {
  Length out{0, has_percent(word)};
  out.value = std::strtod(word.c_str(), nullptr);
  return out;
}

}  // namespace viewcell
