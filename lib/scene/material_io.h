// Materials and pictures of scene.json. Private to this room.
#pragma once

#include "base/json.h"
#include "scene/scene.h"

namespace viewcell {

Json to_json(const glm::vec3& v);
Json to_json(const Material& material);
/// Whether version 1 of the format has all that it says.
bool is_of_version_1(const Material& material);

glm::vec3 color_at(const JsonCursor& cursor, double most);
Material read_material(const JsonCursor& cursor);
void remark_material_keys(const JsonCursor& material, Remarks& remarks);

/// Lists and hashes the pictures of the scene's materials. Throws InputError (file, place) for one
/// that is not there.
void list_pictures(const std::filesystem::path& scene_file, Scene& scene);

}  // namespace viewcell
