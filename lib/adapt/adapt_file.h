// Reads and writes logs of adaptations: .adapt, a section file (docs/formats.md).
#pragma once

#include <filesystem>
#include <string>

#include "adapt/adaptation.h"

namespace viewcell {

/// hash_hex of all of a progressive mesh that its adaptations depend on; the same at every level.
std::string adaptation_hash(const ProgressiveRecord& record);

/// Whole or not at all. record: the progressive mesh that the log is of.
void write_adapt(const std::filesystem::path& file, const AdaptationLog& log,
                 const ProgressiveRecord& record);

/// Throws InputError for a file that is not whole, whose numbers are out of range, or that is of
/// another progressive mesh than record.
AdaptationLog read_adapt(const std::filesystem::path& file, const ProgressiveRecord& record);

}  // namespace viewcell
