#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certificate/capability.h"
#include "certificate/localised_text.h"
#include "certificate/profile.h"

namespace gumcert::certificate {

// What a laboratory states on a certificate beside the numbers (ISO/IEC 17025:2017, 7.8.2.1 and 7.8.4.1): the object
// `certificate` of a job, or a file of its own. docs/certificate_data.md explains every key to users. Dates are texts
// "2026-11-21" (ISO 8601), checked by the reader; "" where none is given. Texts are UTF-8, never markup.

/// In one form or the other, or both: parts by name, and lines as they are printed (certificate/address_lines.h).
struct Address {
    std::vector<std::string> lines = {};  ///< the whole address, or what stands above its named parts
    std::string country = {};             ///< ISO 3166-1, two letters
    std::string street = {}, street_no = {}, post_office_box = {}, postcode = {}, city = {}, state = {};
    friend bool operator==(const Address&, const Address&) = default;
};

struct Laboratory {
    LocalisedText name;
    Address address;
    std::string email, telephone, web;
    std::string code;             ///< calibration laboratory code, if the national body gives one
    std::string logo;             ///< PNG, JPEG or SVG, name beside the job; "": none
    std::string logo_sha256;      ///< of the file, filled by the reader
    std::string logo_media_type;  ///< "image/png", "image/jpeg", "image/svg+xml"
    std::string logo_base64;      ///< its bytes, as of the symbol of an accreditation
};

/// One line of the scope of accreditation.
struct ScopeEntry {
    std::string id;
    LocalisedText measurand;  ///< as the scope words it
    std::vector<std::string>
        results;  ///< names of results that it covers: "l", "EXA", "R_up"; "E*" covers all that begin so
    std::vector<std::string> methods;  ///< identifications of methods; empty: any
    std::vector<std::string> places;   ///< "laboratory", "customer_site" …; empty: "laboratory" only
    struct Range {
        CapabilityArgument argument;
        double low = 0.0, high = 0.0;  ///< in argument.unit
    };
    std::vector<Range> ranges;
    Capability capability;
};

struct Accreditation {
    LocalisedText body;
    std::string number;
    std::string standard = "ISO/IEC 17025:2017";
    std::string valid_from, valid_to;        ///< of the scope
    std::optional<std::string> symbol_file;  ///< PNG, JPEG or SVG supplied by the laboratory, name beside the job
    std::string symbol_sha256;               ///< of the file, filled by the reader
    std::string symbol_media_type;           ///< "image/png", "image/jpeg", "image/svg+xml"
    std::string symbol_base64;               ///< its bytes, so that a record can be printed again by itself
    std::vector<ScopeEntry> scope;
    std::vector<std::string> signatories;  ///< persons who may authorise accredited certificates; empty: see persons
};

struct Customer {
    LocalisedText name;
    Address address;
    std::string contact, email;
    std::string order;  ///< the customer's order number
};

struct Item {
    LocalisedText description;
    std::string manufacturer, type, serial_number;
    std::string identification;  ///< assigned by customer or laboratory
    LocalisedText condition;     ///< on receipt; "no damage seen" is a condition
    std::string owner;
    std::vector<std::string> stated_by_customer;  ///< keys of this object that the customer stated: "serial_number" …
};

struct Place {
    std::string kind = "laboratory";  ///< "laboratory", "customer_site", "mobile", "temporary"
    Address address;                  ///< needed unless it is the laboratory's
    LocalisedText description;        ///< "measuring room 2"
};

struct Dates {
    std::string received, performed_from, performed_to, authorised, issued;
};

struct Method {
    std::string identification, version;
    LocalisedText title, description;
    std::string standard;                   ///< "ISO 230-7:2015"
    std::string valid_from, valid_to;       ///< of this version of the method
    std::vector<LocalisedText> deviations;  ///< additions, deviations, exclusions; empty together with `no_deviations`
    bool no_deviations = false;             ///< stated explicitly: none
};

/// A measurement standard or instrument that traceability rests on.
struct StandardUsed {
    LocalisedText name;
    std::string identification, certificate;
    LocalisedText issuer;
    std::string issuer_accreditation;  ///< number, or "NMI"
    std::string route;                 ///< ILAC-P10:07/2020: "1" NMI, "2" accredited, "3a", "3b", "in_house", "crm"
    std::string evidence;              ///< of competence, where the route demands it
    std::string calibrated, valid_to;
    std::string role = "working";  ///< "reference" or "working"
    std::optional<double> U, k;    ///< headline uncertainty of the certificate
    /// The largest U with this k, in `unit`, where several lines of the certificate were used; U is the smallest then
    std::optional<double> U_to;
    std::string unit;
    /// The same of another kind of quantity: currents of a standard whose U above is that of voltages.
    struct FurtherUncertainty {
        double U = 0.0;
        std::optional<double> U_to, k;
        std::string unit;
    };
    std::vector<FurtherUncertainty> further;
    bool conformity_statement_only = false;  ///< no values: its limits are in the budget
    std::string sha256;                      ///< of the certificate, a DCC for instance
};

/// A condition that influences the result, as observed during the work (ISO/IEC 17025:2017, 7.8.4.1 b).
struct Condition {
    LocalisedText quantity;
    std::string kind;  ///< "temperature", "humidity", "pressure" or "" for others; for the DCC
    double minimum = 0.0, maximum = 0.0;
    std::string unit;
    std::optional<double> U;  ///< of the sensor, expanded, in `unit`
    std::string sensor;
    std::optional<double> lower_limit, upper_limit;  ///< of the method
};

struct Person {
    std::string name;
    LocalisedText function;
    std::string authorised_from, authorised_to;  ///< for this kind of work; "" without limit
};

struct Persons {
    std::optional<Person> performed_by, reviewed_by, authorised_by;
};

/// Limits that differ from point to point of a table; docs/certificate_data.md.
struct PointLimits {
    /// "points": their columns limit_low, limit_high or mpe. Else the largest permissible error: "accuracy" of an
    /// instrument, "steps" of an argument, "expression" of arguments
    std::string by;
    std::string about;                   ///< column or input that the limits lie about; "": 0
    std::string of;                      ///< accuracy: column or input that was read
    std::string range_column = "range";  ///< accuracy: column with the words of Accuracy::range
    struct Accuracy {
        std::string range;  ///< word of the points that it holds for; "": all that no entry before names
        std::string unit;   ///< of full_scale, digit and constant; "": that of the specification
        std::optional<double> percent_of_reading, percent_of_range, full_scale, digits, digit, constant;
    };
    std::vector<Accuracy> accuracy;
    struct Step {
        double up_to = 0.0;  ///< in the unit of the argument
        double mpe = 0.0;    ///< in the unit of the specification
    };
    std::vector<Step> steps;                    ///< rising
    std::vector<CapabilityArgument> arguments;  ///< steps: one; `of` names a column or an input
    std::string expression;                     ///< plain numbers, as in a capability
    /// In place of `expression`: the limits themselves, in the unit of the specification; "" one that there is not
    std::string limit_low, limit_high;
};

/// An agreed specification and the rule by which conformity is decided (ISO/IEC 17025:2017, 7.1.3 and 7.8.6).
struct AgreedSpecification {
    std::string id;
    std::vector<std::string> results;    ///< as in ScopeEntry::results
    std::optional<double> lower, upper;  ///< tolerance limits, in `unit`; one or both
    std::optional<PointLimits> limits;   ///< in place of them, where the limits differ from point to point
    std::string unit;
    std::string document, edition, clause;
    struct Rule {
        std::string id;                      ///< "DR-01" … "DR-13": gum/conformity/conformity.h
        std::optional<double> guard_factor;  ///< r of w = r U
        std::optional<double> guard_band;    ///< w itself, in `unit`
        std::optional<double> probability;   ///< conformance probability or largest risk that the rule demands
        std::optional<double> test_uncertainty_ratio;  ///< least TUR (DR-02, DR-09, DR-10)
        std::optional<double> largest_U;               ///< in `unit` (DR-02)
        std::string alternative;                       ///< rule id where the ratio is not reached (DR-02, DR-09)
        std::optional<double> population_reliability;  ///< EOPR in-tolerance probability of the population (DR-09)
        std::optional<double> population_deviation;    ///< s0, in `unit`
        std::optional<double> population_centre;       ///< in `unit`; the middle of two limits where it is not stated
        std::string method;                            ///< of DR-09: "1" … "6", "rds", "rp10"
        LocalisedText text;                            ///< wording agreed with the customer (DR-12, DR-13)
        std::string prescribed_by;  ///< customer, regulation or standard that prescribes it: 7.8.6.1 note
    } rule;
    std::string agreed_by, agreed_on, agreement;  ///< person, date, reference of the contract
};

struct Opinion {
    LocalisedText text, basis;
    Person author;
};

/// Results that another laboratory provided (ISO/IEC 17025:2017, 7.8.2.1 p).
struct ExternalResults {
    std::vector<std::string> results;
    LocalisedText provider;
};

struct Amendment {
    std::string kind;  ///< "amended" or "replaced"
    std::string number;
    std::string sha256;  ///< of the earlier document, if it was a file
    LocalisedText reason;
    std::vector<LocalisedText> changes;
    /// File beside the job: the record of the earlier certificate, which is compared with this one
    std::string record = {};
};

/// An item that is left out with a reason ("unless the laboratory has valid reasons").
struct Omission {
    std::string clause;  ///< "7.8.2.1 h"
    LocalisedText reason;
};

/// A finding of the audit of the budgets that somebody accepts, with a reason. It is printed under the deviations, and
/// no longer blocks the issue (certificate/waiver.h).
struct Waiver {
    std::string finding;  ///< rule of the audit: "U10"
    std::string where;    ///< place as the finding has it; "" every finding of the rule
    std::string by;       ///< who accepts it
    std::string date;     ///< when
    LocalisedText reason;
    friend bool operator==(const Waiver&, const Waiver&) = default;
};

struct Adjustment {
    bool adjusted = false;
    LocalisedText as_found;  ///< where the results before adjustment stand, or why there are none
};

struct Parameter {
    std::string name, unit;
    double value = 0.0;
};

/// What holds for the results of one section of a job in place of what the certificate states for all
/// (certificate/section_data.h).
struct SectionData {
    std::string section;  ///< its name in the job
    std::optional<Item> item;
    std::optional<Method> method;
    std::vector<std::string> standards;  ///< identifications of rows of `standards`; empty: all
    std::vector<Condition> conditions;   ///< empty: those of the certificate
};

struct CertificateData {
    /// "accredited", "not_accredited" or "specimen". Without the key: accredited where an accreditation is stated, else
    /// specimen.
    std::string status = "specimen";
    std::string number;
    std::vector<std::string> languages = {"en"};  ///< the first one is binding; at most two are printed side by side
    std::string profile = "ilac";                 ///< templates/profiles/<profile>.json
    std::optional<Profile> own_profile;           ///< from a file beside the job, where `profile` names one
    Laboratory laboratory;
    std::optional<Accreditation> accreditation;
    Customer customer;
    Item item;
    Place place;
    Dates dates;
    Method method;
    std::vector<StandardUsed> standards;
    std::vector<Condition> conditions;
    Persons persons;
    std::vector<AgreedSpecification> specifications;
    std::vector<Opinion> opinions;
    std::vector<LocalisedText> remarks;
    std::vector<ExternalResults> external_results;
    std::vector<Parameter> parameters;  ///< for capabilities
    LocalisedText sampling;             ///< empty: not applicable
    std::optional<Adjustment> adjustment;
    std::string simplified_agreement;  ///< reference of the agreement on a simplified report (7.8.1.3)
    std::string recalibration_date, recalibration_agreement;
    std::optional<Amendment> amendment;
    std::vector<Omission> omissions;
    std::vector<Waiver> waivers;
    /// What stands behind the certified part of documents: "none", "summary" (the budgets), "full"; "", where the
    /// laboratory states nothing, is full.
    std::string annexes;
    std::vector<SectionData> sections;  ///< those that state something of their own
};

}  // namespace gumcert::certificate
