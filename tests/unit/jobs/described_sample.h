#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
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
void describe(Archive& a, Sample& r) {
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
    a.list("entries", r.entries, "Several of them.", 3);
    a.named("by_name", r.entries, "Several of them, by name.");
    a.array("angles", In{}, 1, 4, "Several numbers.");
    a.array_or_part("either", In{}, 1, 4, r.either, "The ones or the other.");
    a.by_hand("special", "{}", "anything", "Read by code.");
    a.at_least_one_of({"count", "name"});
}

}  // namespace gumcert::jobs::test
