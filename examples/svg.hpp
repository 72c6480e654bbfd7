// Pictures for the examples: panels side by side with triangles, segments and a caption each, and a key of the colours, written as SVG.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

class Picture {
public:
    using Point = std::array<double, 2>;

    // Every panel shows the same box, panel_width pixels wide. The key says what the shades mean, from the value 0 to 1.
    Picture(Point low, Point high, double panel_width, int n_columns, std::string least, std::string most)
        : least_(std::move(least)), most_(std::move(most)), low_(low), scale_(panel_width / (high[0] - low[0])), width_(panel_width + gap), n_columns_(n_columns),
          height_((high[1] - low[1]) * scale_ + caption_height) {}

    // What is drawn from now on goes to a further panel.
    void panel(const std::string &caption) {
        finish_panel();
        caption_ = caption;
        n_panels_++;
    }

    // Filled by a value from 0 to 1.
    void triangle(double value, const double *a, const double *b, const double *c) { polygon(value, {a, b, c}); }

    void polygon(double value, const std::vector<const double *> &corners) {
        const double shade = std::floor(value * n_shades);
        fills_[static_cast<std::size_t>(std::clamp(shade, 0.0, n_shades - 1.0))] += lines(corners) + 'z';
    }

    void segment(const double *a, const double *b) { strokes_ += lines({a, b}); }

    // Whether the file has been written.
    bool save(const std::string &path) {
        finish_panel();
        const int n_rows = (n_panels_ + n_columns_ - 1) / n_columns_;
        const double width = width_ * std::min(n_panels_, n_columns_) + gap, height = height_ * n_rows + gap;
        const std::string size = number(width) + "\" height=\"" + number(height + key_height) + "\"";
        std::ofstream file(path);
        file << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << size << " role=\"img\">\n<style>"
             << "text{font:14px system-ui,'DejaVu Sans',sans-serif;fill:#24292f;text-anchor:middle}"
             << "path{stroke-linejoin:round;stroke-linecap:round;fill:none;stroke:#fff;stroke-width:2}"
             << ".strokes{stroke:#b3470a;stroke-width:12}</style>\n"
             << "<rect width=\"" << size << " rx=\"10\" fill=\"#fff\"/>\n" << panels_ << key(width / 2, height) << "</svg>\n";
        file.close();
        return file.good();
    }

private:
    static constexpr std::size_t n_shades = 8;
    static constexpr double gap = 12, caption_height = 34, key_height = 30, patch = 22;
    static constexpr double units = 10;  // to a pixel: coordinates are whole numbers

    static std::string number(double value) { return std::to_string(std::lround(value)); }

    std::pair<long, long> place(const double *p) const {
        return {std::lround(units * scale_ * (p[0] - low_[0])), -std::lround(units * scale_ * (p[1] - low_[1]))};
    }

    // From the first point on by differences, which are shorter.
    std::string lines(const std::vector<const double *> &points) const {
        std::string path;
        std::pair<long, long> last{0, 0};
        for (const double *point : points) {
            const auto [x, y] = place(point);
            const std::string dy = std::to_string(y - last.second);
            const char *command = path.empty() ? "M" : point == points.begin()[1] ? "l" : " ";
            path += command + std::to_string(x - last.first) + (dy[0] == '-' ? "" : " ") + dy;
            last = {x, y};
        }
        return path;
    }

    // The shades in a row, with what the first and the last stand for.
    std::string key(double middle, double top) const {
        std::string text;
        const double left = middle - patch * n_shades / 2;
        for (std::size_t shade = 0; shade < n_shades; shade++)
            text += "<rect x=\"" + number(left + patch * static_cast<double>(shade)) + "\" y=\"" + number(top) + "\" width=\"" +
                    number(patch) + "\" height=\"14\" fill=\"" + shades[shade] + "\"/>";
        const auto label = [&](double x, const char *anchor, const std::string &words) {
            text += "<text x=\"" + number(x) + "\" y=\"" + number(top + 12) + "\" style=\"text-anchor:" + anchor + "\">" + words +
                    "</text>";
        };
        label(left - gap, "end", least_);
        label(middle + patch * n_shades / 2 + gap, "start", most_);
        return text + "\n";
    }

    void finish_panel() {
        if (n_panels_ == 0) return;
        const int at = n_panels_ - 1;
        const double x = gap + width_ * (at % n_columns_), bottom = height_ * (at / n_columns_ + 1) - caption_height;
        panels_ += "<g transform=\"translate(" + number(x) + " " + number(bottom + gap) + ")\">" +
                   "<g transform=\"scale(.1)\">\n";
        for (std::size_t shade = 0; shade < n_shades; shade++) {
            if (!fills_[shade].empty())
                panels_ += std::string("<path style=\"fill:") + shades[shade] + "\" d=\"" + fills_[shade] + "\"/>\n";
            fills_[shade].clear();
        }
        if (!strokes_.empty()) panels_ += "<path class=\"strokes\" d=\"" + strokes_ + "\"/>\n";
        strokes_.clear();
        panels_ += "</g><text x=\"" + number((width_ - gap) / 2) + "\" y=\"22\">" + caption_ + "</text></g>\n";
    }

    static constexpr const char *shades[n_shades] = {"#e3eefa", "#c3dbf0", "#97c2e3", "#68a4d3",
                                                     "#4385c0", "#2867a8", "#164a87", "#0a2f5f"};
    std::string least_, most_;
    Point low_;
    double scale_, width_;
    int n_columns_, n_panels_ = 0;
    double height_;
    std::string caption_, panels_, strokes_;
    std::array<std::string, n_shades> fills_;
};
