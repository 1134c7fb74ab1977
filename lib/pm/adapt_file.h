// Reads and writes logs of adaptations: .adapt, a section file (docs/formats.md).
#pragma once

#include <filesystem>

#include "pm/adaptation.h"

namespace viewcell {

/// Whole or not at all. record: the progressive mesh that the log is of.
void write_adapt(const std::filesystem::path& file, const AdaptationLog& log,
                 const ProgressiveRecord& record);

/// Throws InputError for a file that is not whole, whose numbers are out of range, or that is of
/// another progressive mesh than record.
AdaptationLog read_adapt(const std::filesystem::path& file, const ProgressiveRecord& record);

}  // namespace viewcell
