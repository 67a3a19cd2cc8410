#include "core/render/font.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <cstdint>

#include "core/error.h"

// The font's file, put into the program by the assembler.
asm(".section .rodata\n"
    ".global wellspaced_font_begin\n"
    ".global wellspaced_font_end\n"
    "wellspaced_font_begin:\n"
    ".incbin \"" WELLSPACED_FONT
    "\"\n"
    "wellspaced_font_end:\n"
    ".byte 0\n"
    ".previous\n");
extern "C" const unsigned char wellspaced_font_begin[], wellspaced_font_end[];

namespace wellspaced {
namespace {

/// Takes a character off the front; 0xfffd for bytes that are none.
std::uint32_t take_character(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  const std::size_t bytes = lead < 0x80 ? 1 : lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 0;
  std::uint32_t code = bytes == 1 ? lead : lead & (0x7fu >> bytes);
  bool sound = bytes != 0 && bytes <= text.size();
  for (std::size_t i = 1; sound && i < bytes; ++i) {
    sound = (byte(i) & 0xc0) == 0x80;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  text.remove_prefix(sound ? bytes : 1);
  return sound ? code : 0xfffd;
}

/// From font units, y up, to pixels.
struct Placing {
  Vec2 at;
  double scale;
  bool upward;
  GlyphPen* pen;

  Vec2 operator()(const FT_Vector* v) const {
    const double x = static_cast<double>(v->x) * scale, y = static_cast<double>(v->y) * scale;
    return upward ? Vec2{at.x - y, at.y - x} : Vec2{at.x + x, at.y - y};
  }
};

const Placing& placing(void* user) { return *static_cast<const Placing*>(user); }

const FT_Outline_Funcs outline_funcs = {
    [](const FT_Vector* to, void* user) {
      placing(user).pen->move_to(placing(user)(to));
      return 0;
    },
    [](const FT_Vector* to, void* user) {
      placing(user).pen->line_to(placing(user)(to));
      return 0;
    },
    [](const FT_Vector* control, const FT_Vector* to, void* user) {
      placing(user).pen->curve_to(placing(user)(control), placing(user)(to));
      return 0;
    },
    [](const FT_Vector*, const FT_Vector*, const FT_Vector*, void*) { return 1; },  // TrueType has none
    0,
    0};

}  // namespace

class Font::Impl {
 public:
  Impl() {
    const auto bytes = static_cast<FT_Long>(wellspaced_font_end - wellspaced_font_begin);
    if (FT_Init_FreeType(&library_) != 0) throw Error(ErrorCode::internal, "no FreeType");
    if (FT_New_Memory_Face(library_, wellspaced_font_begin, bytes, 0, &face_) != 0) {
      FT_Done_FreeType(library_);
      throw Error(ErrorCode::internal, "the font can't be read");
    }
  }
  ~Impl() {
    FT_Done_Face(face_);
    FT_Done_FreeType(library_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  double unit() const { return 1.0 / face_->units_per_EM; }

  /// The glyph of a character, in font units; nothing if it can't be loaded.
  FT_GlyphSlot load(std::uint32_t code) const {
    const FT_UInt index = FT_Get_Char_Index(face_, code);
    return FT_Load_Glyph(face_, index, FT_LOAD_NO_SCALE) == 0 ? face_->glyph : nullptr;
  }

 private:
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

Font::Font() : impl_(std::make_unique<Impl>()) {}
Font::~Font() = default;
Font::Font(Font&&) noexcept = default;

double Font::width_px(std::string_view text, double size_px) const {
  double units = 0;
  while (!text.empty())
    if (const auto* glyph = impl_->load(take_character(text))) units += static_cast<double>(glyph->advance.x);
  return units * impl_->unit() * size_px;
}

double Font::width_px(std::span<const TextRun> runs, double size_px) const {
  double width = 0;
  for (const TextRun& run : runs) width += width_px(run.text, run_size_px(run, size_px));
  return width;
}

void Font::outline(std::string_view text, double size_px, Vec2 at, bool upward, GlyphPen& pen) const {
  Placing placing{at, size_px * impl_->unit(), upward, &pen};
  while (!text.empty()) {
    auto* glyph = impl_->load(take_character(text));
    if (glyph == nullptr) continue;
    FT_Outline_Decompose(&glyph->outline, &outline_funcs, &placing);
    const double advance = static_cast<double>(glyph->advance.x) * placing.scale;
    placing.at =
        upward ? Vec2{placing.at.x, placing.at.y - advance} : Vec2{placing.at.x + advance, placing.at.y};
  }
}

std::string fitted(const Font& font, std::string_view text, double size_px, double width_px) {
  if (font.width_px(text, size_px) <= width_px) return std::string(text);
  const auto with_dots = [&] { return std::string(text) + "…"; };
  while (!text.empty() && font.width_px(with_dots(), size_px) > width_px) {
    while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.remove_suffix(1);
    text.remove_suffix(1);
  }
  return with_dots();
}

}  // namespace wellspaced
