#include "archive/state_statement.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace gumcert::archive {
namespace {

StateStatement statement() {
    return {.at = "2026-11-24T10:00:00Z",
            .certificates = {{.number = "EX-1", .state = "superseded", .later = "EX-1/A1", .entries = {2, 3, 11}},
                             {.number = "EX-1/A1", .state = "issued", .later = "", .entries = {12}}}};
}

Head head() {
    Head head;
    head.archive = "an archive";
    head.size = 12;
    head.root = "a root";
    head.chain = "a chain";
    head.at = "2026-11-24T09:59:00Z";
    return head;
}

/// What another program signs: fields with their length in front, 8 bytes, the highest first (ADR 0062).
TEST(StateStatement, IsSignedFieldByField) {
    const std::vector<std::string> fields{"gumcert/archive/states/1",
                                          "an archive",
                                          "12",
                                          "a root",
                                          "a chain",
                                          "2026-11-24T09:59:00Z",
                                          "EX-1/A1",
                                          "2026-11-24T10:00:00Z",
                                          "EX-1",
                                          "superseded",
                                          "EX-1/A1",
                                          "2 3 11",
                                          "EX-1/A1",
                                          "issued",
                                          "",
                                          "12"};
    std::string expected;
    for (const std::string& field : fields) {
        expected += std::string(7, '\0') + static_cast<char>(field.size()) + field;
    }
    EXPECT_EQ(signed_bytes(statement(), head(), "EX-1/A1"), expected);
}

/// A signature is over all that is stated: no two statements have the same bytes, nor do those in which something has moved
/// from one field to the next.
TEST(StateStatement, AnythingElseHasOtherBytes) {
    using Change = std::function<void(StateStatement&, Head&, std::string&)>;
    const std::vector<Change> changes{
        [](StateStatement&, Head&, std::string&) {},
        [](StateStatement& s, Head&, std::string&) { s.at = "2026-11-24T10:00:01Z"; },
        [](StateStatement& s, Head&, std::string&) { s.certificates[0].number = "EX-2"; },
        [](StateStatement& s, Head&, std::string&) { s.certificates[0].state = "issued"; },
        [](StateStatement& s, Head&, std::string&) { s.certificates[0].later = ""; },
        [](StateStatement& s, Head&, std::string&) {
            s.certificates[0].entries = {2, 31, 1};
        },
        [](StateStatement& s, Head&, std::string&) {
            s.certificates[0].entries = {2, 3};
        },
        [](StateStatement& s, Head&, std::string&) {
            s.certificates[0].entries = {23, 11};
        },
        [](StateStatement& s, Head&, std::string&) { s.certificates.pop_back(); },
        [](StateStatement& s, Head&, std::string&) { std::swap(s.certificates[0], s.certificates[1]); },
        [](StateStatement& s, Head&, std::string&) {
            s.certificates[1].number = "EX-1/A1i";
            s.certificates[1].state = "ssued";
        },
        [](StateStatement&, Head& h, std::string&) { h.archive = "another"; },
        [](StateStatement&, Head& h, std::string&) { h.size = 13; },
        [](StateStatement&, Head& h, std::string&) { h.root = "b root"; },
        [](StateStatement&, Head& h, std::string&) { h.chain = "b chain"; },
        [](StateStatement&, Head& h, std::string&) { h.at = "2026-11-24T09:59:01Z"; },
        [](StateStatement&, Head&, std::string& certificate) { certificate = "EX-1"; }};
    std::set<std::string> bytes;
    for (const Change& change : changes) {
        StateStatement stated = statement();
        Head of_head = head();
        std::string certificate = "EX-1/A1";
        change(stated, of_head, certificate);
        EXPECT_TRUE(bytes.insert(signed_bytes(stated, of_head, certificate)).second) << bytes.size();
    }
    StateStatement with_signature = statement();
    with_signature.signature = Head::Signature{};
    EXPECT_TRUE(bytes.contains(signed_bytes(with_signature, head(), "EX-1/A1"))) << "a signature does not sign itself";
}

}  // namespace
}  // namespace gumcert::archive
