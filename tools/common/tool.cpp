#include "common/tool.h"

#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <new>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "base/version.h"
#include "common/progress_line.h"
#include "common/signals.h"

namespace viewcell {
namespace {

using Words = std::vector<std::string>;

std::string first_name(const std::string& names) {
  return names.substr(0, names.find(','));
}

// What an option for text was given.
Words words_of(const Target& target) {
  if (const auto* word = std::get_if<std::string*>(&target)) return {**word};
  if (const auto* path = std::get_if<std::filesystem::path*>(&target)) return {(*path)->string()};
  if (const auto* words = std::get_if<Words*>(&target)) return **words;
  throw BugError("an option names a file, but holds no text");
}

NamedFile fill_in(NamedFile file, const std::string& path) {
  if (const std::size_t at = file.name.find('%'); at != std::string::npos)
    file.name.replace(at, 1, path);
  file.path = path;
  return file;
}

}  // namespace

// Hands a command line to CLI11 and takes from it what was typed.
class Parser {
 public:
  Parser(Tool& tool, const std::string& example)
      : tool_(tool), app_(tool.description_, tool.name_) {
    app_.set_version_flag("--version", tool.name_ + " (viewcell) " + version());
    app_.footer("Example:\n  " + example + "\n");
    app_.get_formatter()->column_width(34);
    if (!tool.commands_.empty()) {
      app_.require_subcommand(1);
      app_.fallthrough();
    }
    fill(app_, tool);
    for (Command& command : tool.commands_) {
      CLI::App& own = *app_.add_subcommand(command.name_, command.description_);
      fill(own, command);
      own.footer(format_common_options() + "\nExample:\n  " + example + "\n");
    }
  }

  void parse(int argc, char** argv) {
    app_.parse(argc, argv);
    for (const auto& [option, parsed] : options_) option->is_given = parsed->count() > 0;
    for (Command& command : tool_.commands_) command.is_given_ = app_.got_subcommand(command.name_);
  }

  /// After parsing: the files that options name; -o and --json before other outputs.
  void find_files(std::vector<NamedFile>& inputs, std::vector<NamedFile>& outputs) const {
    find_files(tool_, inputs, outputs);
    for (const Command& command : tool_.commands_) find_files(command, inputs, outputs);
    const auto rank = [](const NamedFile& f) {
      return f.name == "-o" ? 0 : f.name == "--json" ? 1 : 2;
    };
    std::stable_sort(outputs.begin(), outputs.end(),
                     [&](const NamedFile& a, const NamedFile& b) { return rank(a) < rank(b); });
  }

  /// What --help or --version shows.
  std::string answer(const CLI::Success& success) const {
    std::ostringstream out;
    app_.exit(success, out, out);
    return out.str();
  }

 private:
  // The tool's own options, which may stand behind a command, for its --help.
  std::string format_common_options() {
    const std::vector<const CLI::Option*> options =
        std::as_const(app_).get_options([](const CLI::Option* option) {
          return option->get_name() != "--help" && option->get_name() != "--version";
        });
    const auto formatter = std::dynamic_pointer_cast<CLI::Formatter>(app_.get_formatter());
    VIEWCELL_CHECK(formatter != nullptr);
    return formatter->make_group("Options of all commands", false, options);
  }

  static CLI::Option* add(CLI::App& app, const Option& option) {
    const auto declare = [&](auto* target) -> CLI::Option* {
      if constexpr (std::is_same_v<decltype(target), bool*>)
        return app.add_flag(option.names, *target, option.help);
      else
        return app.add_option(option.names, *target, option.help);
    };
    CLI::Option* out = std::visit(declare, option.target);
    out->required(option.is_required);
    if (option.is_default_shown) out->capture_default_str();
    if (option.is_one_each) out->expected(1)->take_all();
    if (option.most_listed > 0) out->delimiter(',')->expected(1, option.most_listed);
    if (option.rule) out->check(option.rule->find_fault, option.rule->shown);
    return out;
  }

  void fill(CLI::App& app, Command& command) {
    const std::size_t n_before = options_.size();
    for (Option& option : command.options_) options_.emplace_back(&option, add(app, option));
    for (std::size_t i = n_before; i < options_.size(); ++i) {
      const auto [option, added] = options_[i];
      for (const std::string& other : option->needed) added->needs(app.get_option(other));
      for (const std::string& other : option->excluded) added->excludes(app.get_option(other));
    }
  }

  static void find_files(const Command& command, std::vector<NamedFile>& inputs,
                         std::vector<NamedFile>& outputs) {
    for (const Option& option : command.options_) {
      if (!option.is_given || !(option.read || option.written)) continue;
      for (const std::string& word : words_of(option.target)) {
        const std::string path = option.path_of ? option.path_of(word).string() : word;
        if (option.read) inputs.push_back(fill_in(*option.read, path));
        if (option.written) outputs.push_back(fill_in(*option.written, path));
      }
    }
  }

  Tool& tool_;
  CLI::App app_;
  std::vector<std::pair<Option*, CLI::Option*>> options_;
};

namespace {

// An exception's text on one line, whatever it holds.
std::string one_line(const std::string& text) {
  std::string out;
  for (const char c : text) out += (c == '\n' || c == '\r' || c == '\t') ? ' ' : c;
  return out;
}

// A closed standard stream's number would be given to the next file that is opened, and what is
// meant for the stream written there. These fail instead.
void keep_standard_streams() {
  for (const int fd : {0, 1, 2})
    if (::fcntl(fd, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(::open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY));
}

Check make_check(const CLI::Validator& validator) {
  return {[validator](const std::string& word) { return validator(word); },
          validator.get_description()};
}

}  // namespace

Check within(double lo, double hi) {
  std::ostringstream range;
  range << lo << " to " << hi;
  const auto check = [lo, hi, text = range.str()](const std::string& given) {
    double x = 0;
    if (CLI::detail::lexical_cast(given, x) && x >= lo && x <= hi) return std::string();
    return "'" + given + "' is not within " + text;
  };
  return {check, range.str()};
}

Check in_range(int lo, int hi) {
  return make_check(CLI::Range(lo, hi));
}

Check in_range(std::size_t lo, std::size_t hi) {
  return make_check(CLI::Range(lo, hi));
}

Check one_of(const std::vector<std::string>& words) {
  return make_check(CLI::IsMember(words));
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

Check whole_within(std::uint64_t lo, std::uint64_t hi) {
  const std::string range = std::to_string(lo) + " to " + std::to_string(hi);
  const auto check = [lo, hi, range](const std::string& given) {
    std::size_t ignored = 0;
    if (parse_whole(given, lo, hi, ignored)) return std::string();
    return "'" + given + "' is not a whole number from " + range;
  };
  return {check, range};
}

Option& Option::reads(const std::string& name, const std::vector<std::string>& inside) {
  read = NamedFile{name, "", inside};
  return *this;
}

Option& Option::reads(const std::string& name,
                      std::filesystem::path (*path)(const std::string& word)) {
  path_of = path;
  return reads(name);
}

Option& Option::writes(const std::vector<std::string>& inside) {
  written = NamedFile{first_name(names), "", inside};
  return *this;
}

Option& Command::add_option(const std::string& names, Target target, const std::string& help) {
  return options_.emplace_back(Option{names, target, help});
}

Option& Command::add_flag(const std::string& names, bool* target, const std::string& help) {
  return options_.emplace_back(Option{names, target, help});
}

Command& Command::add_command(const std::string& name, const std::string& description) {
  return commands_.emplace_back(name, description);
}

bool Command::is_given(const std::string& option) const {
  const auto is_it = [&](const Option& o) { return o.names == option; };
  const auto found = std::find_if(options_.begin(), options_.end(), is_it);
  VIEWCELL_CHECK(found != options_.end(), option);
  return found->is_given;
}

const Command& Command::command(const std::string& name) const {
  const auto is_it = [&](const Command& c) { return c.name_ == name; };
  const auto found = std::find_if(commands_.begin(), commands_.end(), is_it);
  VIEWCELL_CHECK(found != commands_.end(), name);
  return *found;
}

Tool::Tool(const std::string& name, const std::string& description, const std::string& example)
    : Command(name, description), example_(example) {
  add_flag("-q,--quiet", &common_.quiet, "no progress, remarks and summary on stderr");
  add_option("-j,--threads", &common_.n_threads, "threads (0: all cores)").check(in_range(0, 1024));
  add_option("--json", &common_.json_file, "write a report as JSON to this file (-: stdout)")
      .writes();
}

void Tool::add_output(const std::string& description, bool required) {
  declare_output(description, required).writes();
}

void Tool::add_output_folder(const std::string& description, const std::vector<std::string>& inside,
                             bool required) {
  declare_output(description, required).writes(inside);
}

void Tool::add_output_stem(const std::string& description) {
  declare_output(description, true);
}

void Tool::add_mesh_limit(Command& command) {
  constexpr std::size_t kMost = 4294967295;  // a vertex is a number of 32 bits
  command
      .add_option(
          "--max-triangles", &common_.max_triangles,
          "a mesh file that would grow to more, by instances or packed, is refused before it "
          "does (default: 16777216, or 8 for each of its bytes where that is more)")
      .check(in_range(std::size_t{1}, kMost));
}

Option& Tool::declare_output(const std::string& description, bool required) {
  Option& option = add_option("-o,--output", &common_.output, description);
  option.is_required = required;
  return option.check(
      {[](const std::string& word) { return std::string(word.empty() ? "is no name" : ""); }, ""});
}

void Tool::reads(const std::vector<NamedFile>& files) {
  inputs_.insert(inputs_.end(), files.begin(), files.end());
  if (is_running_) check_all_files();
}

void Tool::writes(const std::vector<NamedFile>& files) {
  outputs_.insert(outputs_.end(), files.begin(), files.end());
  if (is_running_) check_all_files();
}

void Tool::check_all_files() const {
  check_files(inputs_, outputs_);
  check_places(outputs_);
}

int Tool::main(int argc, char** argv, const std::function<int()>& run) {
  return main(
      argc, argv, [] {}, run);
}

int Tool::main(int argc, char** argv, const std::function<void()>& prepare,
               const std::function<int()>& run) {
  const auto fail = [&](int code, const std::string& text) {
    std::cerr << name() << ": " << one_line(text) << "\n";
    return code;
  };
  keep_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // ulimit -f: a write that fails, not an end without a word
  try {
    const SignalGuard guard;
    Parser parser(*this, example_);
    try {
      parser.parse(argc, argv);
    } catch (const CLI::Success& success) {  // --help, --version
      write_file("-", parser.answer(success));
      return 0;
    }
    parser.find_files(inputs_, outputs_);
    prepare();
    check_all_files();
    is_running_ = true;
    return run();
  } catch (const CLI::Error& error) {
    return fail(2, std::string(error.what()) + " (see " + name() + " --help)");
  } catch (const UsageError& error) {
    return fail(2, std::string(error.what()) + " (see " + name() + " --help)");
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
  const char* terminal = std::getenv("TERM");
  const bool is_dumb = terminal == nullptr || std::string(terminal) == "dumb";
  if (common_.quiet || is_dumb || isatty(2) == 0) return {};
  return [line = std::make_shared<ProgressLine>(name() + ": " + what)](
             std::size_t done, std::size_t total) { line->show(done, total); };
}

void Tool::say(const std::string& line) const {
  if (!common_.quiet) std::cerr << name() << ": " << line << "\n";
}

void Tool::warn(const std::string& line) const {
  std::cerr << name() << ": " << one_line(line) << "\n";
}

void Tool::remark(const std::filesystem::path& file, const Remarks& remarks) const {
  for (const auto& [what, count] : remarks) {
    say(one_line(file.string() + ": " + what) + " (" + std::to_string(count) + ")");
    remarks_.push_back({{"file", file.filename()}, {"what", what}, {"count", count}});
  }
}

void Tool::report(const Json& json) const {
  if (common_.json_file.empty()) return;
  Json whole = json;
  if (!remarks_.empty()) whole["remarks"] = remarks_;
  write_file(common_.json_file, format_json(whole));
}

}  // namespace viewcell
