// Attributes of EXR headers, before OpenEXR reads them. Private to this room.
#pragma once

#include <string_view>

namespace viewcell {

/// Whether the value is as long as its type asks for. OpenEXR goes by the type and not by the size
/// that stands before the value, and would take what follows for names and sizes. Lists of channels
/// must also have samples of a kind that there is, for OpenImageIO ends the program at others, and
/// steps of at least one pixel. Types that OpenEXR does not know may have any value.
bool is_sound_exr_attribute(std::string_view type, std::string_view value);

}  // namespace viewcell
