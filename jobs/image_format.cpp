#include "jobs/image_format.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "jobs/svg_image.h"
#include "text/counts.h"

namespace gumcert::jobs {

namespace {

std::uint32_t octet_at(std::string_view bytes, std::size_t i) {
    return static_cast<unsigned char>(bytes[i]);
}

std::uint32_t big_endian_32(std::string_view bytes, std::size_t i) {
    return octet_at(bytes, i) << 24U | octet_at(bytes, i + 1) << 16U | octet_at(bytes, i + 2) << 8U |
           octet_at(bytes, i + 3);
}

std::uint32_t big_endian_16(std::string_view bytes, std::size_t i) {
    return octet_at(bytes, i) << 8U | octet_at(bytes, i + 1);
}

constexpr std::uint32_t k_largest_side = 10000;

std::string side_objection(std::uint32_t width, std::uint32_t height) {
    const auto outside = [](std::uint32_t side) { return side == 0 || side > k_largest_side; };
    return outside(width) || outside(height)
               ? "an image of " + std::to_string(width) + " by " + text::count_of(height, "pixel")
               : "";
}

/// Width and height stand in the first chunk, IHDR; the last one is IEND (ISO/IEC 15948:2004, 5.6 and 11.2).
ImageFormat png_format(std::string_view bytes) {
    constexpr std::size_t k_signature = 8;
    constexpr std::size_t k_around = 12;  // length, type and check sum of a chunk
    bool has_data = false;
    for (std::size_t at = k_signature; at + k_around <= bytes.size();) {
        const std::size_t length = big_endian_32(bytes, at);
        const std::string_view type = bytes.substr(at + 4, 4);
        if (length > bytes.size() - at - k_around) {
            break;
        }
        if (at == k_signature) {
            if (type != "IHDR" || length != 13) {
                return {"", "a PNG file that does not begin with its header"};
            }
            if (std::string objection = side_objection(big_endian_32(bytes, at + 8), big_endian_32(bytes, at + 12));
                !objection.empty()) {
                return {"", std::move(objection)};
            }
        }
        has_data = has_data || type == "IDAT";
        at += k_around + length;
        if (type == "IEND") {
            return has_data && at == bytes.size() ? ImageFormat{"image/png", ""}
                                                  : ImageFormat{"", has_data ? "a PNG file with bytes after its end"
                                                                             : "a PNG file without pixels"};
        }
    }
    return {"", "a PNG file that is cut off"};
}

/// Width and height stand in the start-of-frame segment, which comes before the scan (ISO/IEC 10918-1:1994, annex B).
ImageFormat jpeg_format(std::string_view bytes) {
    bool has_frame = false;
    for (std::size_t at = 2; at + 4 <= bytes.size();) {
        if (octet_at(bytes, at) != 0xFFU) {
            break;
        }
        const std::uint32_t marker = octet_at(bytes, at + 1);
        if (marker == 0xFFU) {  // a fill byte
            ++at;
            continue;
        }
        const std::size_t length = big_endian_16(bytes, at + 2);
        if (length < 2 || length > bytes.size() - at - 2) {
            break;
        }
        const bool is_frame =
            marker >= 0xC0U && marker <= 0xCFU && marker != 0xC4U && marker != 0xC8U && marker != 0xCCU;
        if (is_frame) {
            if (length < 8) {
                break;
            }
            if (std::string objection = side_objection(big_endian_16(bytes, at + 7), big_endian_16(bytes, at + 5));
                !objection.empty()) {
                return {"", std::move(objection)};
            }
            has_frame = true;
        }
        if (marker == 0xDAU) {
            return has_frame && bytes.ends_with("\xFF\xD9") ? ImageFormat{"image/jpeg", ""}
                                                            : ImageFormat{"", "a JPEG file that is cut off"};
        }
        at += 2 + length;
    }
    return {"", "a JPEG file that is cut off"};
}

}  // namespace

ImageFormat image_format(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG\r\n\x1A\n")) {
        return png_format(bytes);
    }
    if (bytes.starts_with("\xFF\xD8\xFF")) {
        return jpeg_format(bytes);
    }
    if (looks_like_svg(bytes)) {
        std::string objection = svg_objection(bytes);
        return {objection.empty() ? "image/svg+xml" : "", std::move(objection)};
    }
    return {"", bytes.empty() ? "an empty file" : "a file of another format"};
}

}  // namespace gumcert::jobs
