#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "certificate/dates.h"
#include "certificate/gates/finding_list.h"
#include "certificate/gates/gates.h"
#include "certificate/stated_text.h"
#include "certificate/text_words.h"
#include "gum/argument_check.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "text/numbers.h"

namespace gumcert::certificate {

namespace {

// --- texts ---

/// A field that tells one thing from others, and what it is called in a message.
struct IdentifyingText {
    const char* where;
    const char* what;
    std::u32string letters;
};

std::u32string letters_if_stated(const std::string& text) {
    return is_stated(text) ? letters_of(text) : std::u32string();
}

std::vector<IdentifyingText> identifying_texts(const CertificateData& data) {
    std::vector<IdentifyingText> all = {
        {"/number", "the number of the certificate", letters_if_stated(data.number)},
        {"/laboratory/name", "the name of the laboratory", letters_if_stated(data.laboratory.name.in("en"))},
        {"/method/identification", "the identification of the method", letters_if_stated(data.method.identification)},
        {"/item/description", "the description of the item", letters_if_stated(data.item.description.in("en"))},
        {"/item/serial_number", "the serial number of the item", letters_if_stated(data.item.serial_number)},
        {"/item/condition", "the condition of the item", letters_if_stated(data.item.condition.in("en"))},
        {"/customer/name", "the name of the customer", letters_if_stated(data.customer.name.in("en"))}};
    if (data.accreditation) {
        all.insert(all.begin() + 2, {{"/accreditation/body", "the accreditation body",
                                      letters_if_stated(data.accreditation->body.in("en"))},
                                     {"/accreditation/number", "the number of the accreditation",
                                      letters_if_stated(data.accreditation->number)}});
    }
    std::erase_if(all, [](const IdentifyingText& text) { return text.letters.empty(); });
    return all;
}

/// Fields of different meaning must not hold the same text. The laboratory as its own customer is looked at below.
void same_texts(FindingList& found, const CertificateData& data) {
    const std::vector<IdentifyingText> all = identifying_texts(data);
    const auto names = [](const IdentifyingText& a, const IdentifyingText& b) {
        return std::string(a.where) == "/laboratory/name" && std::string(b.where) == "/customer/name";
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto first = std::find_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i),
                                        [&](const IdentifyingText& t) { return t.letters == all[i].letters; });
        if (first == all.begin() + static_cast<std::ptrdiff_t>(i) || names(*first, all[i])) {
            continue;
        }
        // Two equal fields may be a slip; one text in three or more of them was filled in to satisfy a form.
        const auto number = std::count_if(all.begin(), all.end(),
                                          [&](const IdentifyingText& t) { return t.letters == all[i].letters; });
        found.add(number > 2 ? FindingSeverity::critical : FindingSeverity::major, "Q01", iso_17025("7.8.2.1"),
                  all[i].where, std::string(all[i].what) + " has the same text as " + first->what,
                  "State each of them as it is.");
    }
}

void own_customer(FindingList& found, const CertificateData& data) {
    const std::u32string laboratory = letters_if_stated(data.laboratory.name.in("en"));
    if (!laboratory.empty() && laboratory == letters_if_stated(data.customer.name.in("en"))) {
        found.add(FindingSeverity::minor, "Q02", iso_17025("7.8.2.1 e"), "/customer/name",
                  "the laboratory is its own customer",
                  "Say so in the remarks where it is meant; else state the customer.");
    }
}

// --- persons ---

bool same_person(const std::optional<Person>& a, const std::optional<Person>& b) {
    return a && b && is_same_name(a->name, b->name);
}

void plausible_persons(FindingList& found, const CertificateData& data, const Profile& profile) {
    const auto& [performed_by, reviewed_by, authorised_by] = data.persons;
    if (!performed_by || !is_name(performed_by->name)) {
        found.add(FindingSeverity::minor, "P06", iso_17025("7.8.1.1"), "/persons/performed_by",
                  "it is not said who did the work", "State name and function.");
    }
    const bool told_by_profile = !profile.reviewer_may_be_performer && !reviewed_by;
    if ((!reviewed_by || !is_name(reviewed_by->name)) && !told_by_profile) {
        found.major("P06", iso_17025("7.8.1.1"), "/persons/reviewed_by", "it is not said who reviewed the results",
                    "State name and function: results are reviewed before they are released.");
    }
    if (same_person(performed_by, reviewed_by) && same_person(performed_by, authorised_by)) {
        found.major("P07", iso_17025("7.8.1.1"), "/persons",
                    performed_by->name + " did the work, reviewed it and authorised the certificate",
                    "Let another person review, or describe how the review is done otherwise.");
    }
    if (authorised_by && data.status == "accredited" && authorised_by->authorised_from.empty()) {
        found.add(FindingSeverity::minor, "P09", iso_17025("6.2.6"), "/persons/authorised_by/authorised_from",
                  "it is not said since when " + authorised_by->name + " is authorised", "State the date.");
    }
}

/// Nobody certifies something to himself.
void customers(FindingList& found, const CertificateData& data) {
    const auto check = [&](const std::optional<Person>& person, const char* key, FindingSeverity severity) {
        if (person && is_same_name(person->name, data.customer.name.in("en"))) {
            found.add(severity, "P13", iso_17025("4.1"), "/persons/" + std::string(key),
                      person->name + " acts for the laboratory and is the customer",
                      "Let a person of the laboratory do it, or correct the name of the customer.");
        }
    };
    check(data.persons.performed_by, "performed_by", FindingSeverity::major);
    check(data.persons.reviewed_by, "reviewed_by", FindingSeverity::major);
    check(data.persons.authorised_by, "authorised_by", FindingSeverity::critical);
}

// --- dates ---

constexpr long k_days_of_a_year = 366;

void periods(FindingList& found, const CertificateData& data) {
    const Dates& d = data.dates;
    if (d.authorised.empty()) {
        found.major("P10", iso_17025("7.8.1.1"), "/dates/authorised", "it is not said when the results were authorised",
                    "State the date.");
    }
    const auto longer = [&](const std::string& from, const std::string& to, const char* where, const char* what) {
        if (days_between(from, to).value_or(0) > k_days_of_a_year) {
            found.major("P11", iso_17025("7.5.1"), where,
                        std::string(what) + " (" + from + ", " + to + "), more than a year", "Correct the dates.");
        }
    };
    longer(d.performed_from, d.performed_to, "/dates/performed_to",
           "the work is to have lasted from one day to the other");
    longer(last_day(d), d.issued, "/dates/issued", "the certificate was issued long after the work");
    longer(d.received, d.performed_from, "/dates/received", "the work began long after the item was received");
    // The first day of the month in which the standard was published that every certificate of the program names.
    constexpr const char* k_publication = "2017-11-01";
    if (is_after(k_publication, d.issued)) {
        found.critical("P11", iso_17025("7.5.1"), "/dates/issued",
                       "the certificate was issued on " + d.issued + ", before ISO/IEC 17025:2017 was published",
                       "Correct the date.");
    }
    constexpr long k_longest_interval_in_days = 20 * 366;
    if (days_between(d.issued, data.recalibration_date).value_or(0) > k_longest_interval_in_days) {
        found.major(
            "R08", iso_17025("7.8.4.3"), "/recalibration_date",
            "the date of recalibration, " + data.recalibration_date + ", is more than twenty years after the issue",
            "Correct the date, or leave it out.");
    }
    if (!data.recalibration_date.empty() && !d.issued.empty() && !is_after(data.recalibration_date, d.issued)) {
        found.critical(
            "R08", iso_17025("7.8.4.3"), "/recalibration_date",
            "the date of recalibration, " + data.recalibration_date + ", is not after the date of issue, " + d.issued,
            "Correct the date, or leave it out.");
    }
}

// --- conditions ---

/// What a condition is of, by its kind or by the words of its name.
bool is_of(const Condition& c, const char* kind, const std::vector<std::u32string>& words) {
    if (!c.kind.empty()) {
        return c.kind == kind;
    }
    std::vector<std::string> texts = {c.quantity.plain};
    for (const auto& [language, text] : c.quantity.by_language) {
        texts.push_back(text);
    }
    return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
        const std::u32string letters = letters_of(text);
        return std::any_of(words.begin(), words.end(),
                           [&](const std::u32string& word) { return letters.find(word) != std::u32string::npos; });
    });
}

bool has_word(const Condition& c, const std::vector<std::u32string>& words) {
    Condition named = c;
    named.kind.clear();
    return is_of(named, "", words);
}

/// A temperature itself, not how it changes or differs.
bool is_temperature(const Condition& c) {
    return c.kind == "temperature" ||
           (c.kind.empty() && has_word(c, {U"temperatur", U"溫度", U"温度"}) &&
            !has_word(c, {U"differ",  U"differenz", U"diferencia", U"gradient",   U"gradiente", U"change",
                          U"variat",  U"variac",    U"stabil",     U"estabil",    U"deviat",    U"abweichung",
                          U"desviac", U"drift",     U"deriva",     U"schwankung", U"anderung",  U"spread",
                          U"差",      U"變",        U"变",         U"梯"}));
}

/// "RH", "r. F.", "HR": what a humidity is called in short.
bool is_short_for_humidity(const Condition& c) {
    const std::u32string letters = letters_of(c.quantity.in("en"));
    return c.kind.empty() && (letters == U"rh" || letters == U"rf" || letters == U"hr" || letters == U"relh");
}

/// Why a condition cannot have been observed; "" where it can.
std::string impossible(const Condition& c) {
    constexpr double k_absolute_zero = -273.15;  // in degrees Celsius
    gum::Unit unit;
    try {
        unit = gum::Unit::parse(c.unit);
    } catch (const gum::InputError&) {
        return {};
    }
    const double low = unit.to_si(c.minimum);
    const double high = unit.to_si(c.maximum);
    const bool thermal = unit.dimension() == gum::Dimension::temperature();
    if (c.kind == "temperature" && !thermal) {
        return "a temperature has no unit \"" + c.unit + "\"";
    }
    if (thermal && unit.is_celsius_temperature() && low < k_absolute_zero) {
        return text::shortest(c.minimum) + " " + c.unit + " is below absolute zero";
    }
    if (thermal && !unit.is_celsius_temperature() && is_temperature(c) && low <= 0.0) {
        return text::shortest(c.minimum) + " " + c.unit + " is not above absolute zero";
    }
    if (is_short_for_humidity(c) ||
        is_of(c, "humidity", {U"humidity", U"feuchte", U"feuchtigkeit", U"humedad", U"濕度", U"湿度"})) {
        // An absolute humidity has a unit such as g/m³, and no upper limit that could be named here.
        if (c.kind == "humidity" && !unit.dimension().is_one() && low < 0.0) {
            return text::shortest(c.minimum) + " " + c.unit + " of water are less than none";
        }
        if (unit.dimension().is_one() && (low < 0.0 || high > 1.0)) {
            return "a relative humidity is between 0 % and 100 %";
        }
    }
    if (is_of(c, "pressure",
              {U"airpressure", U"atmosphericpressure", U"barometric", U"ambientpressure", U"pressureofair",
               U"pressureoftheair", U"luftdruck", U"umgebungsdruck", U"atmospharendruck", U"atmospharischerdruck",
               U"presionatmosferica", U"presiondelaire", U"presionbarometrica", U"presionambiente", U"大氣壓",
               U"大气压", U"气压", U"氣壓"})) {
        if (!(unit.dimension() == gum::Unit::parse("Pa").dimension())) {
            return c.kind == "pressure" ? "a pressure has no unit \"" + c.unit + "\"" : "";
        }
        return low <= 0.0 ? text::shortest(c.minimum) + " " + c.unit + " is no pressure of air" : "";
    }
    return {};
}

/// Limits and sensors so wide that a condition tells nothing, in the SI unit of its kind.
void wide_condition(FindingList& found, const Condition& c, std::size_t i) {
    gum::Unit unit;
    try {
        unit = gum::Unit::parse(c.unit);
    } catch (const gum::InputError&) {
        return;
    }
    const bool thermal = unit.dimension() == gum::Dimension::temperature();
    const bool pressure = unit.dimension() == gum::Unit::parse("Pa").dimension();
    const double widest = thermal ? 100.0 : pressure ? 50000.0 : 0.0;  // of the surroundings of a measurement
    const double largest_U = thermal ? 10.0 : pressure ? 5000.0 : 0.0;
    const double allowed = c.lower_limit && c.upper_limit ? *c.upper_limit - *c.lower_limit : 0.0;
    if (widest > 0.0 && unit.difference_to_si(c.maximum - c.minimum) > widest) {
        found.major("E03", iso_17025("7.8.4.1 b"), place_in("/conditions", i),
                    "\"" + c.quantity.in("en") + "\" is stated from " + text::shortest(c.minimum) + " " + c.unit +
                        " to " + text::shortest(c.maximum) + " " + c.unit + ", which is too wide to tell anything",
                    "Correct number, unit or kind.");
    }
    const bool beside_limits = allowed > 0.0 && c.U && *c.U > allowed;
    if (c.U && (beside_limits || (largest_U > 0.0 && unit.difference_to_si(*c.U) > largest_U))) {
        found.major("E03", iso_17025("7.8.4.1 b"), place_in("/conditions", i, "U"),
                    "\"" + c.quantity.in("en") + "\" was measured with an uncertainty of " + text::shortest(*c.U) +
                        " " + c.unit + ", which is too large to tell anything",
                    "Correct number, unit or kind.");
    }
}

/// At least one condition is a physical quantity: numbers of dimension one, humidity apart, describe no surroundings.
void physical(FindingList& found, const CertificateData& data) {
    const auto of_nature = [](const Condition& c) {
        try {
            return !c.kind.empty() || !gum::Unit::parse(c.unit).dimension().is_one() || is_short_for_humidity(c) ||
                   has_word(c, {U"humid", U"feucht", U"humedad", U"濕度", U"湿度"});
        } catch (const gum::InputError&) {
            return true;
        }
    };
    if (!data.conditions.empty() && std::none_of(data.conditions.begin(), data.conditions.end(), of_nature)) {
        found.major("R07-4b", iso_17025("7.8.4.1 b"), "/conditions", "none of the conditions has a physical unit",
                    "State them as observed.");
    }
}

void plausible_conditions(FindingList& found, const CertificateData& data) {
    physical(found, data);
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
        const Condition& c = data.conditions[i];
        if (!is_name(c.quantity)) {
            found.critical("R07-4b", iso_17025("7.8.4.1 b"), place_in("/conditions", i, "quantity"),
                           "it is not said which condition was observed", "Name the quantity.");
        }
        if (const std::string why = impossible(c); !why.empty()) {
            found.critical("E02", iso_17025("7.8.4.1 b"), place_in("/conditions", i),
                           "\"" + c.quantity.in("en") + "\" cannot have been observed: " + why,
                           "Correct number, unit or kind.");
        } else {
            wide_condition(found, c, i);
        }
    }
}

void agreements(FindingList& found, const CertificateData& data) {
    if (!data.simplified_agreement.empty() && !is_identification(data.simplified_agreement)) {
        found.major("R15", iso_17025("7.8.1.3"), "/simplified_agreement",
                    "the report is simplified, and the agreement with the customer is not identified",
                    "State the reference of the agreement.");
    }
    for (std::size_t i = 0; i < data.external_results.size(); ++i) {
        const std::u32string provider = letters_if_stated(data.external_results[i].provider.in("en"));
        if (!provider.empty() && provider == letters_if_stated(data.laboratory.name.in("en"))) {
            found.major("R09", iso_17025("7.8.2.1 p"), place_in("/external_results", i, "provider"),
                        "the laboratory itself is named as the external provider of results",
                        "Name the other laboratory, or remove the entry.");
        }
    }
}

}  // namespace

std::vector<Finding> plausibility_findings(const Certificate& certificate) {
    const CertificateData& data = certificate.data;
    FindingList found(data);
    same_texts(found, data);
    own_customer(found, data);
    plausible_persons(found, data, certificate.profile);
    customers(found, data);
    periods(found, data);
    plausible_conditions(found, data);
    agreements(found, data);
    return found.take();
}

}  // namespace gumcert::certificate
