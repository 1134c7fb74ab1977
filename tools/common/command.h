// What may be typed at a tool: options, flags, words without a name, commands of its own. Plain
// data here; Tool (tool.h) hands it to the parser, which nothing else knows.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/files.h"

namespace viewcell {

/// The variable that a word goes into; what it holds before is the default. bool: a flag's.
using Target = std::variant<bool*, std::string*, std::filesystem::path*, int*, std::size_t*, float*,
                            double*, std::vector<std::string>*, std::optional<std::string>*,
                            std::optional<int>*, std::optional<std::uint32_t>*,
                            std::optional<std::size_t>*, std::optional<double>*>;

/// What a word must be. find_fault says what is wrong with it, or ""; shown stands in --help.
struct Check {
  std::function<std::string(const std::string& word)> find_fault;
  std::string shown;
};

/// A number within [lo, hi]; not NaN.
Check within(double lo, double hi);
/// A whole number within [lo, hi], also typed as 0x10.
Check in_range(int lo, int hi);
Check in_range(std::size_t lo, std::size_t hi);
/// Digits alone, lo to hi.
Check whole_within(std::uint64_t lo, std::uint64_t hi);
Check one_of(const std::vector<std::string>& words);

/// Digits alone, and lo to hi; otherwise false, and n stays.
bool parse_whole(const std::string& text, std::uint64_t lo, std::uint64_t hi, std::size_t& n);

/// An option or a flag ("--size", "-o,--output"), or, without a dash, a word in its turn ("MESH").
struct Option {
  std::string names;
  Target target;
  std::string help;
  bool is_required = false, is_default_shown = false;
  bool is_one_each = false;  ///< of several words: one each time that the option is typed
  int most_listed = 0;       ///< above 0: so many words at most, commas between them
  std::optional<Check> rule = {};
  std::vector<std::string> needed = {}, excluded = {};  ///< names of options of the same command
  bool is_given = false;                                ///< after parsing: it was typed
  std::optional<NamedFile> read = {}, written = {};  ///< what the word names; the path comes later
  std::filesystem::path (*path_of)(const std::string& word) = nullptr;  ///< null: it is the word

  Option& required() { return is_required = true, *this; }
  Option& show_default() { return is_default_shown = true, *this; }
  Option& one_each() { return is_one_each = true, *this; }
  Option& list(int most) { return most_listed = most, *this; }
  Option& check(const Check& check) { return rule = check, *this; }
  Option& needs(const std::string& name) { return needed.push_back(name), *this; }
  Option& excludes(const std::string& name) { return excluded.push_back(name), *this; }
  /// The word names a file that is read, called so in errors (a % is the path); with `inside` a
  /// folder (files.h). A word that holds more than a path has it taken out by path_of.
  Option& reads(const std::string& name, const std::vector<std::string>& inside = {});
  Option& reads(const std::string& name, std::filesystem::path (*path_of)(const std::string& word));
  /// The word names a file or a folder that is written.
  Option& writes(const std::vector<std::string>& inside = {});
};

/// A tool's command line, or that of one of its commands (pmesh build).
class Command {
 public:
  Command(const std::string& name, const std::string& description)
      : name_(name), description_(description) {}
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  const std::string& name() const { return name_; }
  const std::string& description() const { return description_; }

  Option& add_option(const std::string& names, Target target, const std::string& help);
  /// names may end in one that says no: "--ssim,!--no-ssim".
  Option& add_flag(const std::string& names, bool* target, const std::string& help);
  /// One of a tool's commands must be typed; the tool's options may stand behind it.
  Command& add_command(const std::string& name, const std::string& description);

  /// After parsing: whether the command (of a tool's commands), or an option of it, was typed.
  bool is_given() const { return is_given_; }
  bool is_given(const std::string& option_names) const;
  const Command& command(const std::string& name) const;

 private:
  friend class Parser;
  std::string name_, description_;
  std::deque<Option> options_;  // deques: references stay
  std::deque<Command> commands_;
  bool is_given_ = false;
};

}  // namespace viewcell
