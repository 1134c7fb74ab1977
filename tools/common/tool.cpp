#include "common/tool.h"

#include <unistd.h>

#include <charconv>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>
#include <sstream>

#include "base/error.h"
#include "base/file.h"
#include "base/version.h"

namespace viewcell {
namespace {

// An exception's text on one line, whatever it holds.
std::string one_line(const std::string& text) {
  std::string out;
  for (const char c : text) out += (c == '\n' || c == '\r' || c == '\t') ? ' ' : c;
  return out;
}

}  // namespace

CLI::Validator within(double lo, double hi) {
  std::ostringstream range;
  range << lo << " to " << hi;
  const auto check = [lo, hi, text = range.str()](std::string& given) {
    double x = 0;
    if (CLI::detail::lexical_cast(given, x) && x >= lo && x <= hi) return std::string();
    return "'" + given + "' is not within " + text;
  };
  return {check, range.str()};
}

bool parse_whole(const std::string& text, std::uint64_t lo, std::uint64_t hi, std::size_t& n) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  if (std::from_chars(text.data(), end, value) != std::from_chars_result{end, std::errc()} ||
      value < lo || value > hi)
    return false;
  n = value;
  return true;
}

CLI::Validator whole_within(std::uint64_t lo, std::uint64_t hi) {
  const std::string range = std::to_string(lo) + " to " + std::to_string(hi);
  const auto check = [lo, hi, range](std::string& given) {
    std::size_t ignored = 0;
    if (parse_whole(given, lo, hi, ignored)) return std::string();
    return "'" + given + "' is not a whole number from " + range;
  };
  return {check, range};
}

Tool::Tool(const std::string& name, const std::string& description, const std::string& example)
    : name_(name), app_(description, name) {
  app_.set_version_flag("--version", name + " (viewcell) " + version());
  app_.add_flag("-q,--quiet", common_.quiet, "no progress and no summary on stderr");
  app_.add_option("-j,--threads", common_.n_threads, "threads (0: all cores)")
      ->check(CLI::Range(0, 1024));
  app_.add_option("--json", common_.json_file, "write a report as JSON to this file (-: stdout)");
  app_.footer("Example:\n  " + example + "\n");
  app_.get_formatter()->column_width(34);
}

void Tool::add_output(const std::string& description, bool required) {
  CLI::Option* option = app_.add_option("-o,--output", common_.output, description);
  option->check(
      [](const std::string& name) { return name.empty() ? "is no name" : std::string(); });
  if (required) option->required();
}

int Tool::main(int argc, char** argv, const std::function<int()>& run) {
  const auto fail = [&](int code, const std::string& text) {
    std::cerr << name_ << ": " << one_line(text) << "\n";
    return code;
  };
  std::signal(SIGXFSZ, SIG_IGN);  // ulimit -f: a write that fails, not an end without a word
  try {
    app_.parse(argc, argv);
    return run();
  } catch (const CLI::Success& success) {  // --help, --version
    return app_.exit(success);
  } catch (const CLI::Error& error) {
    return fail(2, std::string(error.what()) + " (see " + name_ + " --help)");
  } catch (const UsageError& error) {
    return fail(2, std::string(error.what()) + " (see " + name_ + " --help)");
  } catch (const InputError& error) {
    return fail(1, error.what());
  } catch (const MachineError& error) {
    return fail(3, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(3, error.what());
  } catch (const std::bad_alloc&) {
    return fail(3, "out of memory");
  } catch (const std::exception& error) {
    return fail(4, std::string("a bug: ") + error.what());
  }
}

Progress Tool::progress(const std::string& what) const {
  if (common_.quiet || !isatty(2)) return {};
  return [what, name = name_](std::size_t done, std::size_t total) {
    std::fprintf(stderr, "\r%s: %s %zu of %zu%s", name.c_str(), what.c_str(), done, total,
                 done == total ? "\n" : "");
  };
}

void Tool::say(const std::string& line) const {
  if (!common_.quiet) std::cerr << name_ << ": " << line << "\n";
}

void Tool::report(const Json& json) const {
  if (!common_.json_file.empty()) write_file(common_.json_file, format_json(json));
}

}  // namespace viewcell
