#include "evaluation/record_differences.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "json/canonical_json.h"
#include "json/step.h"
#include "text/utf8.h"

namespace gumcert::evaluation {

namespace {

using gumcert::json::Step;
using nlohmann::json;

constexpr double k_same_number = 1e-9;
constexpr double k_nothing_beside = 1e-12;  // of the largest number of a list
constexpr std::size_t k_longest_text = 120;

double largest_in(const json& list) {
    double largest = 0.0;
    for (const json& item : list) {
        largest = item.is_number() ? std::max(largest, std::abs(item.get<double>())) : largest;
    }
    return largest;
}

/// A square matrix with a diagonal that is not negative: of covariances, whose rows have different units.
bool is_covariance(const json& list) {
    bool is = list.size() > 1;
    for (std::size_t i = 0; is && i < list.size(); ++i) {
        is = list[i].is_array() && list[i].size() == list.size() && list[i][i].is_number() &&
             list[i][i].get<double>() >= 0.0;
    }
    return is;
}

class Comparison {
public:
    explicit Comparison(const DifferenceSink& tell) : tell_(tell) {}

    /// \param scale  of the list that the values stand in; 0 outside of one
    void compare(const json& stated, const json& evaluated, const Step& at, double scale = 0.0) {
        if (stated.is_number() && evaluated.is_number()) {
            const double a = stated.get<double>();
            const double b = evaluated.get<double>();
            const double allowed =
                std::max(k_same_number * std::max(std::abs(a), std::abs(b)), k_nothing_beside * scale);
            if (!(std::abs(a - b) <= allowed)) {
                tell_(at.pointer(), &stated, &evaluated);
            }
        } else if (stated.is_object() && evaluated.is_object()) {
            for (const auto& [key, item] : stated.items()) {
                if (const auto other = evaluated.find(key); other != evaluated.end()) {
                    compare(item, *other, at.child(key));
                } else {
                    tell_(at.child(key).pointer(), &item, nullptr);
                }
            }
            for (const auto& [key, item] : evaluated.items()) {
                if (!stated.contains(key)) {
                    tell_(at.child(key).pointer(), nullptr, &item);
                }
            }
        } else if (stated.is_array() && evaluated.is_array() && stated.size() == evaluated.size()) {
            if (is_covariance(evaluated)) {
                compare_covariance(stated, evaluated, at);
                return;
            }
            const double within = largest_in(evaluated);
            for (std::size_t i = 0; i < stated.size(); ++i) {
                compare(stated[i], evaluated[i], at.child(i), within);
            }
        } else if (stated != evaluated) {
            tell_(at.pointer(), &stated, &evaluated);
        }
    }

private:
    const DifferenceSink& tell_;

    void compare_covariance(const json& stated, const json& evaluated, const Step& at) {
        for (std::size_t i = 0; i < stated.size(); ++i) {
            const Step row = at.child(i);
            if (!stated[i].is_array() || stated[i].size() != stated.size()) {
                tell_(row.pointer(), &stated[i], &evaluated[i]);
                continue;
            }
            for (std::size_t j = 0; j < stated.size(); ++j) {
                const double u = std::sqrt(evaluated[i][i].get<double>() * evaluated[j][j].get<double>());
                compare(stated[i][j], evaluated[i][j], row.child(j), u);
            }
        }
    }
};

}  // namespace

void tell_differences(const json& stated, const json& evaluated, const DifferenceSink& tell) {
    Comparison(tell).compare(stated, evaluated, {});
}

std::string shown_value(const json& value) {
    if (value.is_structured()) {
        return value.is_array() ? "a list of " + std::to_string(value.size()) : "an object";
    }
    std::string text = gumcert::json::canonical_json(value);
    text.pop_back();
    if (text.size() > k_longest_text) {
        std::size_t end = k_longest_text;
        while (end > 0 && text::is_continuation(text[end])) {
            --end;
        }
        text = text.substr(0, end) + "…";
    }
    return text;
}

}  // namespace gumcert::evaluation
