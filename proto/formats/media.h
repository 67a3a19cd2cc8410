#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "proto/formats/csv.h"
#include "proto/formats/npy.h"

namespace wellspaced {

enum class Format { json, npy, csv, svg, png, ply, obj, vtu };

/// "json", "npy", ...: as in ?format= and file extensions.
std::string_view name_of(Format format);
std::string_view media_type_of(Format format);
/// The offered format of this name; nothing if there is none.
std::optional<Format> format_named(std::string_view name, std::span<const Format> offered);

/// The format of a request's body. Errors: unsupported_media_type naming what is taken, and what to send
/// instead of a form.
Format input_format(std::string_view content_type);

/// What an answer is written in: `?format=` wins over `Accept`; the first of `offered` where the client
/// doesn't mind. Errors: not_acceptable listing `offered`.
Format negotiate(std::string_view format_parameter, std::string_view accept, std::span<const Format> offered);

/// Whether it shows a result rather than holding it.
bool is_picture(Format format);
/// Whether it holds a mesh and nothing else.
bool is_mesh(Format format);

}  // namespace wellspaced
