#pragma once

#include <string>
#include <vector>

namespace gumcert::certificate {

/// What the register of the laboratory says, where a job names one: of the standards that budget and certificate use, and
/// of persons. The gates check a certificate against it, and not against what its author states. It stands in no record: the
/// files that it comes from do, and the findings.
struct LaboratoryRegister {
    /// Something that the certificate states and the register says otherwise.
    struct Contradiction {
        std::string where;               ///< JSON pointer in the certificate data: "/standards/0/valid_to"
        std::string subject;             ///< "the standard \"STD-017\"", "the accreditation"
        std::string stated, registered;  ///< as JSON writes them
    };
    /// A standard in an input of the budget.
    struct Use {
        std::string standard, input;
        std::string answer;   ///< whether it is applicable: "yes", "no", "unknown"
        std::string because;  ///< English, without a full stop
        /// Whether the reason is when its calibration is valid, which the dates of its row may show as well.
        bool is_of_validity = false;
    };
    struct Signatory {
        std::string name, from, to;        ///< first and last day; "": no limit
        std::vector<std::string> methods;  ///< identifications of those that the person may sign; empty: any
        bool authorises = true;            ///< may authorise certificates
    };
    /// A standard that the plan of the laboratory wants calibrated again before it is used.
    struct Overdue {
        std::string standard, day;  ///< a day of its use
        std::string due;            ///< by the plan
    };
    std::vector<Contradiction> contradictions;
    std::vector<Overdue> overdue;  ///< one a standard
    std::vector<Use> uses;
    std::vector<std::string> not_registered;  ///< standards that the certificate lists and the register does not have
    std::vector<std::string> not_listed;      ///< used in the budget, and not in the list that the certificate states
    std::vector<Signatory> signatories;
};

}  // namespace gumcert::certificate
