// Textures out of picture files, and out of GLB and glTF files.
#pragma once

#include <filesystem>
#include <string>

#include "formats/material_pictures.h"
#include "image/io.h"

namespace viewcell {

/// Reads a texture; row 0 is v = 1. name is one of
/// - a picture's, as read_image_rgba8 has it ("-": standard input; what it holds decides);
/// - a GLB's or glTF's: its base colour texture;
/// - an OBJ's: the map_Kd of its materials;
/// - "model.glb#SLOT" (or .gltf): the texture of that slot: baseColor, normal, emissive, occlusion
///   or metallicRoughness.
/// Pixels are those of the picture: glTF's factors are not applied, colour spaces not changed.
///
/// All materials that the file's faces have must mean the same picture; materials without that slot
/// are passed over. Throws InputError for several pictures, for none, for one whose texture
/// coordinates are not those of the material's base colour (read_mesh reads these), for an unknown
/// slot, and for anything malformed. hash: hash_hex of the file's bytes, if wanted. lossy_quality:
/// as of decode_texture.
ImageRgba8 read_texture(const std::string& name, std::string* hash = nullptr,
                        const ReadImageOptions& options = {}, int* lossy_quality = nullptr);

/// A picture that a model names. lossy_quality: with which it may as well be stored as JPEG, if
/// wanted: of a JPEG its own, of a lossy WebP 90; 0 where nothing was lost yet, or alpha would be.
ImageRgba8 decode_texture(const ModelPicture& picture, const ReadImageOptions& options = {},
                          int* lossy_quality = nullptr);

/// The file that a texture's name means: without its #SLOT.
std::filesystem::path texture_file(const std::string& name);

}  // namespace viewcell
