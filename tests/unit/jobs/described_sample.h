#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/job_fields.h"

// A struct with a member of every sort that a description knows.

namespace gumcert::jobs::test {

enum class SampleShape { round, square };
inline constexpr Words<SampleShape, 2> k_sample_shapes{
    {{"round", SampleShape::round}, {"square", SampleShape::square}}};

struct SampleInner {
    double u = -1.0;
    std::optional<double> v;
};
struct SampleEntry {
    std::string name;
};
struct Sample {
    double length = -1.0;  ///< [m]
    std::optional<std::size_t> count;
    SampleShape shape = SampleShape::round;
    std::string name = "unnamed";
    std::optional<std::string> file;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    bool turns = false;
    std::optional<SampleInner> inner;
    double a = 0.0;
    std::vector<SampleEntry> entries;
    SampleInner either;
    double computed = 0.0;
    std::string label;
};
struct SampleShared {
    double a = 0.0, b = 0.0;
};

template <class Archive>
void describe(Archive& a, SampleInner& r) {
    a.needed("u", r.u, In{}, "");
    a("v", r.v, In{not_negative("")}, "Of it.");
}

template <class Archive>
void describe(Archive& a, SampleEntry& r) {
    a.needed("name", r.name, AnyText{}, "Of the entry.");
}

template <class Archive>
void describe(Archive& a, SampleShared& r) {
    a.definition("shared", "Written out once.");
    a("a", r.a, In{}, "");
    a("b", r.b, In{}, "");
    a.at_most_one_of({"a", "b"});
}

template <class Archive>
void describe(Archive& a, Sample& r) {
    SampleShared shared;
    std::vector<SampleShared> all_shared;
    a.constant("kind", "sample", "What it is.");
    a.needed("length_um", r.length, In{{.low = 0.0, .high = 5.0, .low_open = true, .unit = "µm"}, 1e-6}, "A length.");
    a("count", r.count, Whole{between(1.0, 10.0, "")}, "A number of things.");
    a("shape", r.shape, k_sample_shapes, "A choice.");
    a("name", r.name, Line{}, "A name.");
    a("file", r.file, FileName{}, "A file.");
    a("point_mm", r.point, In{{.unit = "mm"}, 1e-3}, "A place.");
    a("turns", r.turns, Truth{}, "True or false.");
    a.part("inner", r.inner, "A struct that may be absent.");
    a.needed_part("outer", r, "An object without a struct.", [](auto& in, Sample& sample) {
        in("a", sample.a, In{}, "A number.");
        in.exactly_one_of({"a"});
    });
    a.list("entries", r.entries, "Several of them.", {.most = 3});
    a.needed_named("by_name", r.entries, "Several of them, by name.", {.least = 1, .most = 9});
    a.by_code("angles", Several{In{}, 1, 4}, "Several numbers.");
    a.part_or("either", Several{In{}, 1, 4}, r.either, "The ones or the other.");
    a.part_or("shared", Either{In{}, k_sample_shapes}, shared, "A number, a word or an object.");
    a.list_or("all_shared", FileObject{}, all_shared, "A file, or objects.", {.least = 1});
    a.needed_by_code("pair", Row{Label{}, Null{}}, "A row.");
    a.by_code("rows", Several{Several{In{}, 2}, 0}, "Rows of numbers.");
    a.by_code("numbers", ByName{k_degrees_of_freedom}, "Numbers by name.");
    a("computed", r.computed, In{above_zero(""), 1.0, between(1e-3, 1e3, "")}, "Above zero, and not too large.");
    a("label", r.label, Label{}, "A name or a number.");
    a.by_hand("special", "{}", "anything", "Read by code.");
    a.at_least_one_of({"count", "name"});
    a.needs("count", "name");
    constexpr std::array<std::string_view, 2> k_with_count{"count", "turns"};
    a.all_need(k_with_count, "count");
}

}  // namespace gumcert::jobs::test
