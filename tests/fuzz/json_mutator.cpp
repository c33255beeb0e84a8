// Changes of JSON that leave it JSON, alone or as one of the files of a bundle: with others the search stays at the parser.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/mutated_bytes.h"

namespace gumcert::fuzz {
namespace {

using nlohmann::ordered_json;

void collect_values(ordered_json& value, std::vector<ordered_json*>& all) {
    all.push_back(&value);
    for (ordered_json& child : value) {
        if (value.is_structured()) {
            collect_values(child, all);
        }
    }
}

class JsonMutation {
public:
    explicit JsonMutation(unsigned seed) : random_(seed) {}

    /// Changes a few values; `other` lends parts where it is JSON.
    std::string changed(const std::string& text, const std::string& other) {
        ordered_json document = ordered_json::parse(text, nullptr, false, true);
        if (document.is_discarded()) {
            return mutated_text(text);
        }
        ordered_json lent = ordered_json::parse(other, nullptr, false, true);
        if (lent.is_discarded()) {
            lent = document;
        }
        for (std::size_t change = 0, changes = 1 + below(3); change < changes; ++change) {
            change_one(document, lent);
        }
        return document.dump(static_cast<int>(below(2)) - 1, ' ', false, ordered_json::error_handler_t::replace);
    }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

private:
    ordered_json& one_of(ordered_json& document) {
        std::vector<ordered_json*> all;
        collect_values(document, all);
        return *all[below(all.size())];
    }
    ordered_json::iterator any_of(ordered_json& target) {
        return std::next(target.begin(), static_cast<std::ptrdiff_t>(below(target.size())));
    }

    ordered_json number() {
        static const std::vector<double> k_numbers{0.0,    1.0,  -1.0, 2.0,   0.5,  1e-9, 1e300,  -1e300,
                                                   5e-324, 1e7,  1e-3, 0.999, 95.0, 1e16, 45.0,   360.0,
                                                   3.0,    20.0, -40,  4.0,   10.0, 1e-6, 1000.0, 1e9};
        const double value = k_numbers[below(k_numbers.size())];
        const bool is_whole = std::abs(value) < 1e9 && value == std::floor(value);
        return is_whole && below(2) == 0 ? ordered_json(static_cast<std::int64_t>(value)) : ordered_json(value);
    }

    void change_one(ordered_json& document, ordered_json& lent) {
        ordered_json& target = one_of(document);
        switch (below(9)) {
            case 0:
                target = ordered_json(one_of(lent));
                return;
            case 1:
                target = number();
                return;
            case 2: {
                const ordered_json other = one_of(document);
                target = other;
                return;
            }
            case 3:
                remove_a_member(target);
                return;
            case 4:
                add_a_member(target, one_of(lent));
                return;
            default:
                change_value(target);
        }
    }

    void remove_a_member(ordered_json& target) {
        if (target.is_structured() && !target.empty()) {
            target.erase(any_of(target));
        }
    }

    void add_a_member(ordered_json& target, const ordered_json& value) {
        if (target.is_array()) {
            const ordered_json copy = value;
            target.insert(std::next(target.begin(), static_cast<std::ptrdiff_t>(below(target.size() + 1))), copy);
        } else if (target.is_object()) {
            const std::string word = target.empty() ? "u" : any_of(target).key();
            const ordered_json copy = value;
            target[mutated_text(word)] = copy;
        }
    }

    void change_value(ordered_json& target) {
        if (target.is_string()) {
            target = mutated_text(target.get<std::string>());
        } else if (target.is_number()) {
            const double value = target.get<double>();
            static const std::vector<double> k_factors{-1.0, 10.0, 0.1, 2.0, 1.001, 0.5};
            target = below(3) == 0 ? number() : ordered_json(value * k_factors[below(k_factors.size())]);
        } else if (target.is_boolean()) {
            target = !target.get<bool>();
        } else if (target.is_structured() && !target.empty()) {
            change_value(*any_of(target));
        } else {
            target = number();
        }
    }

    std::mt19937 random_;
};

/// The files of a bundle with the line that begins each; a text without such lines is one file.
std::vector<std::string> files_with_heads(std::string_view text) {
    std::vector<std::string> files;
    while (!text.empty()) {
        const std::size_t next = text.find("\n=== ", 1);
        const std::size_t end = next == std::string_view::npos ? text.size() : next + 1;
        files.emplace_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return files;
}

std::size_t end_of_head(const std::string& file) {
    return file.starts_with("=== ") ? std::min(file.find('\n'), file.size() - 1) + 1 : 0;
}

std::string changed_bundle(std::string_view text, std::string_view other, unsigned seed) {
    JsonMutation mutation(seed);
    std::vector<std::string> files = files_with_heads(text);
    if (files.empty() || mutation.below(8) == 0) {
        return mutated_text(std::string(text));
    }
    std::string& file = files[mutation.below(files.size())];
    const std::size_t head = end_of_head(file);
    const std::vector<std::string> lenders = files_with_heads(other);
    const std::string lender = lenders.empty() ? file : lenders[mutation.below(lenders.size())];
    file = file.substr(0, head) + mutation.changed(file.substr(head), lender.substr(end_of_head(lender)));
    std::string all;
    for (const std::string& part : files) {
        all += part;
        if (&part != &files.back() && !all.ends_with('\n')) {
            all += '\n';
        }
    }
    return all;
}

}  // namespace

std::string changed_input(std::string_view input, std::string_view other, unsigned seed) {
    return changed_bundle(input, other, seed);
}

}  // namespace gumcert::fuzz
