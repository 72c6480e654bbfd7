// SPDX-License-Identifier: GPL-3.0-or-later
#include "npy.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace bench {
namespace {

constexpr char magic[] = "\x93NUMPY";
constexpr std::size_t magic_length = 6;

struct Header {
    std::vector<std::size_t> shape;
    std::size_t item_size = 0;
    std::size_t data_offset = 0;
};

class Reader {
public:
    explicit Reader(const std::string &path) : path_(path) {
        std::ifstream file(path, std::ios::binary);
        if (!file) fail("cannot be opened");
        bytes_.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }

    NpyArray array() const {
        const Header header = parse_header();
        const std::size_t count = element_count(header);
        if (count > (bytes_.size() - header.data_offset) / header.item_size)
            fail(fmt::format("is truncated: {} numbers announced, {} present", count,
                             (bytes_.size() - header.data_offset) / header.item_size));
        NpyArray array;
        array.shape = header.shape;
        array.values.resize(count);
        const char *data = bytes_.data() + header.data_offset;
        if (header.item_size == sizeof(double)) {
            if (count > 0) std::memcpy(array.values.data(), data, count * sizeof(double));
        } else {
            for (std::size_t i = 0; i < count; ++i) {
                float narrow;
                std::memcpy(&narrow, data + i * sizeof narrow, sizeof narrow);
                array.values[i] = narrow;
            }
        }
        return array;
    }

private:
    [[noreturn]] void fail(const std::string &what) const { throw std::runtime_error(path_ + " " + what); }

    Header parse_header() const {
        if (bytes_.size() < magic_length + 4 || std::memcmp(bytes_.data(), magic, magic_length) != 0)
            fail("is not a .npy file");
        const unsigned major = byte(magic_length);
        if (major < 1 || major > 3) fail(fmt::format("has .npy version {}, known are 1 to 3", major));
        const std::size_t n_length_bytes = major == 1 ? 2 : 4;
        const std::size_t text_offset = magic_length + 2 + n_length_bytes;
        if (bytes_.size() < text_offset) fail("is truncated inside its header");
        std::size_t text_length = 0;
        for (std::size_t i = 0; i < n_length_bytes; ++i)
            text_length |= static_cast<std::size_t>(byte(magic_length + 2 + i)) << (8 * i);
        if (bytes_.size() - text_offset < text_length) fail("is truncated inside its header");

        const std::string text(bytes_.data() + text_offset, text_length);
        Header header;
        header.data_offset = text_offset + text_length;
        header.item_size = item_size(text);
        if (value_of(text, "fortran_order").compare(0, 5, "False") != 0) fail("is not in C order");
        header.shape = shape(text);
        return header;
    }

    unsigned byte(std::size_t i) const { return static_cast<unsigned char>(bytes_[i]); }

    /// The header's text from the value of `key` on.
    std::string value_of(const std::string &text, const std::string &key) const {
        std::size_t at = text.find("'" + key + "'");
        if (at == std::string::npos) fail("has no '" + key + "' in its header");
        at = text.find(':', at);
        if (at == std::string::npos) fail("has no value for '" + key + "' in its header");
        at = text.find_first_not_of(' ', at + 1);
        return at == std::string::npos ? std::string() : text.substr(at);
    }

    std::size_t item_size(const std::string &text) const {
        const std::string value = value_of(text, "descr");
        if (value.compare(0, 5, "'<f8'") == 0) return 8;
        if (value.compare(0, 5, "'<f4'") == 0) return 4;
        fail("holds " + value.substr(0, value.find(',')) + ", only '<f8' and '<f4' are read");
    }

    std::vector<std::size_t> shape(const std::string &text) const {
        const std::string value = value_of(text, "shape");
        const std::size_t end = value.find(')');
        if (value.empty() || value[0] != '(' || end == std::string::npos) fail("has no readable shape");
        std::vector<std::size_t> shape;
        for (std::size_t i = 1; i < end;) {
            if (!std::isdigit(static_cast<unsigned char>(value[i]))) {
                ++i;
                continue;
            }
            std::size_t extent = 0;
            for (; i < end && std::isdigit(static_cast<unsigned char>(value[i])); ++i)
                extent = extent * 10 + static_cast<std::size_t>(value[i] - '0');
            shape.push_back(extent);
        }
        return shape;
    }

    std::size_t element_count(const Header &header) const {
        std::size_t count = 1;
        for (const std::size_t extent : header.shape) {
            if (extent != 0 && count > std::numeric_limits<std::size_t>::max() / 16 / extent)
                fail("announces more numbers than memory holds");
            count *= extent;
        }
        return count;
    }

    std::string path_;
    std::vector<char> bytes_;
};

}  // namespace

NpyArray read_npy(const std::string &path) { return Reader(path).array(); }

void write_npy(const std::string &path, const NpyArray &array) {
    std::string text =
        fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, ), }}", fmt::join(array.shape, ", "));
    const std::size_t prefix = magic_length + 4;
    while ((prefix + text.size() + 1) % 64 != 0) text += ' ';
    text += '\n';

    std::ofstream file(path, std::ios::binary);
    const char version_and_length[4] = {1, 0, static_cast<char>(text.size() & 0xff),
                                        static_cast<char>(text.size() >> 8)};
    file.write(magic, magic_length);
    file.write(version_and_length, sizeof version_and_length);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.write(reinterpret_cast<const char *>(array.values.data()),
               static_cast<std::streamsize>(array.values.size() * sizeof(double)));
    if (!file.flush()) throw std::runtime_error(path + " cannot be written");
}

}  // namespace bench
