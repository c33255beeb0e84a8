// Attempts to get the accreditation symbol, or a statement of conformity, for less than it takes: the complete example
// of a certificate with one thing spoilt. Each is refused by the reader or told as a finding; none is silent.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/evaluate_job.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::app {
namespace {

using certificate::Certificate;
using certificate::Finding;
using certificate::FindingSeverity;
using nlohmann::json;

const std::filesystem::path k_tree = GUMCERT_SOURCE_DIR;
const std::filesystem::path k_example = k_tree / "examples" / "certificate";

constexpr FindingSeverity k_critical = FindingSeverity::critical;
constexpr FindingSeverity k_major = FindingSeverity::major;
constexpr FindingSeverity k_minor = FindingSeverity::minor;
constexpr FindingSeverity k_information = FindingSeverity::information;
const char* const k_refused = "refused";

/// What is written at a place of the certificate data, or of the job where the place begins with "job:". "" removes it.
using Change = std::pair<const char*, const char*>;

struct Attempt {
    const char* what;
    std::vector<Change> changes;
    const char* id;  ///< of a finding; or `k_refused`
    FindingSeverity severity = k_critical;
};

json read_json(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return json::parse(in, nullptr, true, true);
}

void change(json& document, const std::string& pointer, const std::string& value) {
    const json::json_pointer place(pointer);
    if (!value.empty()) {
        const bool append = pointer.ends_with("/-");
        append ? document[place.parent_pointer()].push_back(json::parse(value))
               : void(document[place] = json::parse(value));
    } else if (document[place.parent_pointer()].is_array()) {
        document[place.parent_pointer()].erase(static_cast<std::size_t>(std::stoul(place.back())));
    } else {
        document[place.parent_pointer()].erase(place.back());
    }
}

class AttemptsToCheat : public testing::Test {
protected:
    void SetUp() override {
        folder_ = std::filesystem::path(testing::TempDir()) /
                  ("gumcert_attempts_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(folder_);
        std::filesystem::copy_file(k_example / "symbol.png", folder_ / "symbol.png",
                                   std::filesystem::copy_options::overwrite_existing);
        job_ = read_json(k_example / "end_gauge.json");
        data_ = read_json(k_example / "end_gauge_certificate.json");
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    Certificate issued(const std::vector<Change>& changes) const {
        json job = job_;
        json data = data_;
        for (const auto& [pointer, value] : changes) {
            const std::string place = pointer;
            place.starts_with("job:") ? change(job, place.substr(4), value) : change(data, place, value);
        }
        std::ofstream(folder_ / "end_gauge_certificate.json") << data.dump();
        std::ofstream(folder_ / "end_gauge.json") << job.dump();
        return *evaluate_job(folder_ / "end_gauge.json", CovarianceFile::none, 1, k_tree / "templates")
                    .record.certificate;
    }

    void expect_told(const Attempt& attempt) const {
        SCOPED_TRACE(attempt.what);
        try {
            const Certificate certificate = issued(attempt.changes);
            EXPECT_STRNE(attempt.id, k_refused);
            std::string all;
            bool told = false;
            for (const Finding& f : certificate.findings) {
                told = told || (f.id == attempt.id && f.severity == attempt.severity);
                all +=
                    "\n  " + f.id + " " + std::to_string(static_cast<int>(f.severity)) + " " + f.where + ": " + f.what;
            }
            EXPECT_TRUE(told) << attempt.id << " is not told." << (all.empty() ? " SILENT" : all);
            EXPECT_TRUE(attempt.severity != k_critical || certificate.blocked);
            EXPECT_TRUE(attempt.severity != k_critical || !certificate.symbol);
        } catch (const gum::DiagnosedError& error) {
            EXPECT_STREQ(attempt.id, k_refused) << gum::message(error.diagnostics().front());
        }
    }

    std::filesystem::path folder_;
    json job_, data_;
};

const std::vector<Attempt>& attempts() {
    static const std::vector<Attempt> all = {
        // --- identity: nothing stated ---
        {"no number", {{"/number", ""}}, "R07-d"},
        {"number of zeros", {{"/number", R"("0000")"}}, "R07-d"},
        {"number counted up", {{"/number", R"("123456")"}}, "R07-d"},
        {"number to come", {{"/number", R"("TBD")"}}, "R07-d"},
        {"number in Chinese words", {{"/number", R"("待定")"}}, "R07-d"},
        {"laboratory unknown", {{"/laboratory/name", R"("unknown")"}}, "R07-b"},
        {"laboratory of one letter", {{"/laboratory/name", R"("L")"}}, "R07-b"},
        {"laboratory that is a mail address", {{"/laboratory/name", R"("a@example.org")"}}, "R07-b"},
        {"laboratory that is a site", {{"/laboratory/name", R"("https://example.org")"}}, "R07-b"},
        {"laboratory named laboratory", {{"/laboratory/name", R"("The laboratory")"}}, "R07-b"},
        {"laboratory in one language only",
         {{"/laboratory/name", R"({"en": "Example Calibration Laboratory", "de": "unbekannt"})"}},
         "R07-b"},
        {"address only a country", {{"/laboratory/address/lines", R"(["Germany"])"}}, "R07-b"},
        {"address only a country of several words",
         {{"/laboratory/address/lines", R"(["United States of America"])"}},
         "R07-b"},
        {"address without lines", {{"/laboratory/address/lines", "[]"}}, "R07-b"},
        {"address that is a mail address", {{"/laboratory/address/lines", R"(["lab@example.org"])"}}, "R07-b"},
        {"address see above", {{"/laboratory/address/lines", R"(["see above"])"}}, "R07-b"},
        {"address in capital words for nothing", {{"/laboratory/address/lines", R"(["STREET", "TOWN"])"}}, "R07-b"},
        {"no customer", {{"/customer", "{}"}}, "R07-e"},
        {"customer xxx", {{"/customer/name", R"("xxx")"}}, "R07-e"},
        {"customer N.N.", {{"/customer/name", R"("N/A")"}}, "R07-e"},
        {"customer confidential", {{"/customer/name", R"("Confidential")"}}, "R07-e"},
        {"customer customer", {{"/customer/name", R"("customer")"}}, "R07-e"},
        {"unknown customer", {{"/customer/name", R"("Unknown customer")"}}, "R07-e"},
        {"customer unbekannt", {{"/customer/name", R"("Unbekannt")"}}, "R07-e"},
        {"customer desconocido", {{"/customer/name", R"("Desconocido")"}}, "R07-e"},
        {"customer 不明", {{"/customer/name", R"("不明")"}}, "R07-e"},
        {"customer with a Cyrillic o", {{"/customer/name", R"("unknоwn")"}}, "R07-e"},
        {"customer in full width", {{"/customer/name", R"("ＮＯＮＥ")"}}, "R07-e"},
        {"customer with a space of no width", {{"/customer/name", "\"un\u200bknown\""}}, k_refused},
        {"customer that is a number", {{"/customer/name", R"("4711")"}}, "R07-e"},
        {"customer that is a mail address", {{"/customer/name", R"("someone@example.org")"}}, "R07-e"},
        {"customer that cannot be reached",
         {{"/customer/address", ""}, {"/customer/contact", R"("-")"}, {"/customer/email", R"("none")"}},
         "R07-e"},
        {"customer with a wrong mail address alone",
         {{"/customer/address", ""}, {"/customer/contact", ""}, {"/customer/email", R"("at home")"}},
         "R07-e"},
        {"no item", {{"/item", "{}"}}, "R07-g"},
        {"item test", {{"/item/description", R"("Test")"}}, "R07-g"},
        {"item lorem ipsum", {{"/item/description", R"("Lorem ipsum dolor sit amet")"}}, "R07-g"},
        {"item asdf", {{"/item/description", R"("asdf")"}}, "R07-g"},
        {"item siehe oben", {{"/item/description", R"("siehe oben")"}}, "R07-g"},
        {"item véase arriba", {{"/item/description", R"("Véase arriba")"}}, "R07-g"},
        {"item 同上", {{"/item/description", R"("同上")"}}, "R07-g"},
        {"item that is a number", {{"/item/description", R"("50")"}}, "R07-g"},
        {"item without identification",
         {{"/item/serial_number", R"("unknown")"}, {"/item/identification", R"("none")"}},
         "R07-g"},
        {"item of zeros", {{"/item/serial_number", R"("000")"}, {"/item/identification", R"("0")"}}, "R07-g"},
        {"item 9999", {{"/item/serial_number", R"("9999")"}, {"/item/identification", R"("?")"}}, "R07-g"},
        {"condition not stated", {{"/item/condition", R"("not stated")"}}, "R07-g"},
        {"condition k. A.", {{"/item/condition", R"("k. A.")"}}, "R07-g"},
        {"condition keine Angabe", {{"/item/condition", R"("Keine Angabe")"}}, "R07-g"},
        {"condition sin datos", {{"/item/condition", R"("sin datos")"}}, "R07-g"},
        {"condition 未提供", {{"/item/condition", R"("未提供")"}}, "R07-g"},
        {"no method", {{"/method", R"({"no_deviations": true})"}}, "R07-f"},
        {"method n.a.", {{"/method/identification", R"("n. a.")"}}, "R07-f"},
        {"method standard", {{"/method/identification", R"("Standard method")"}}, "R07-f"},
        {"method without version", {{"/method/version", R"("-")"}}, "R07-f", k_major},
        {"work at a place without address",
         {{"/place", R"({"kind": "mobile"})"}, {"/accreditation/scope/0/places", R"(["mobile"])"}},
         "R07-c"},
        {"place on site", {{"/place", R"({"kind": "customer_site", "address": {"lines": ["on site"]}})"}}, "R07-c"},
        // --- omissions ---
        {"everything left out for x",
         {{"/item", "{}"},
          {"/customer", "{}"},
          {"/omissions", R"([{"clause": "7.8.2.1 g", "reason": "x"}, {"clause": "7.8.2.1 e", "reason": "x"}])"}},
         "R07-g"},
        {"item left out for a long reason",
         {{"/item", "{}"},
          {"/omissions", R"([{"clause": "7.8.2.1 g", "reason": "The customer knows very well what it was."}])"}},
         "R07-g"},
        {"method left out for a long reason",
         {{"/method", R"({"no_deviations": true})"},
          {"/omissions", R"([{"clause": "7.8.2.1 f", "reason": "The method is a secret of the laboratory."}])"}},
         "R07-f"},
        {"customer left out for x",
         {{"/customer", "{}"}, {"/omissions", R"([{"clause": "7.8.2.1 e", "reason": "x"}])"}},
         "R07-e"},
        {"customer left out for not needed",
         {{"/customer", "{}"}, {"/omissions", R"([{"clause": "7.8.2.1 e", "reason": "Not needed, see above."}])"}},
         "R07-e"},
        {"customer left out for a reason",
         {{"/customer", "{}"},
          {"/omissions", R"([{"clause": "7.8.2.1 e", "reason": "The owner wishes not to be named on paper."}])"}},
         "R07-e",
         k_major},
        {"omission without effect", {{"/omissions", R"([{"clause": "7.8.2.1 c", "reason": "none"}])"}}, "R16", k_major},
        {"omission of another clause",
         {{"/omissions", R"([{"clause": "7.8.4.1 c", "reason": "The standards are known to everybody."}])"}},
         "R16",
         k_major},
        {"provider left out for a reason",
         {{"/external_results", R"([{"results": ["l"]}])"},
          {"/omissions", R"([{"clause": "7.8.2.1 p", "reason": "The provider wants to stay without name."}])"}},
         "R07-p",
         k_major},
        {"deviations left out for a reason",
         {{"/method/no_deviations", "false"},
          {"/omissions", R"([{"clause": "7.8.2.1 n", "reason": "Nobody wrote the deviations down."}])"}},
         "R07-n",
         k_minor},
        // --- one text for several things ---
        {"number is the serial number", {{"/number", R"("SN-1001")"}}, "Q01", k_major},
        {"number is the accreditation", {{"/number", R"("EX 0000")"}}, "Q01", k_major},
        {"item is its serial number", {{"/item/description", R"("sn 1001")"}}, "Q01", k_major},
        {"customer is the item", {{"/customer/name", R"("End gauge, steel, nominal length 50 mm")"}}, "Q01", k_major},
        {"method is the number", {{"/method/identification", R"("EX-2026-0042")"}}, "Q01", k_major},
        {"condition is the item", {{"/item/condition", R"("End gauge, steel, nominal length 50 mm")"}}, "Q01", k_major},
        {"one text everywhere",
         {{"/number", R"("Gauge 7")"},
          {"/customer/name", R"("Gauge 7")"},
          {"/item/description", R"("Gauge 7")"},
          {"/item/serial_number", R"("Gauge 7")"},
          {"/method/identification", R"("Gauge 7")"}},
         "Q01"},
        {"body is the laboratory", {{"/accreditation/body", R"("Example Calibration Laboratory")"}}, "Q01", k_major},
        {"own customer", {{"/customer/name", R"("EXAMPLE calibration laboratory")"}}, "Q02", k_minor},
        // --- persons ---
        {"nobody authorises", {{"/persons/authorised_by", ""}}, "R07-o"},
        {"N. N. authorises",
         {{"/persons/authorised_by/name", R"("n/n")"}, {"/accreditation/signatories", R"(["n/n"])"}},
         "R07-o",
         k_critical},
        {"one letter authorises",
         {{"/persons/authorised_by/name", R"("H")"}, {"/accreditation/signatories", R"(["H"])"}},
         "R07-o"},
        {"a mail address authorises",
         {{"/persons/authorised_by/name", R"("h@example.org")"},
          {"/accreditation/signatories", R"(["h@example.org"])"}},
         "R07-o"},
        {"somebody authorises", {{"/persons/authorised_by/name", R"("Niemand")"}}, "R07-o"},
        {"authorised without function", {{"/persons/authorised_by/function", R"("-")"}}, "R07-o", k_minor},
        {"no reviewer", {{"/persons/reviewed_by", ""}}, "P06", k_major},
        {"reviewer nobody", {{"/persons/reviewed_by/name", R"("nobody")"}}, "P06", k_major},
        {"reviewer of one letter", {{"/persons/reviewed_by/name", R"("R")"}}, "P06", k_major},
        {"no operator", {{"/persons/performed_by", ""}}, "P06", k_minor},
        {"operator test", {{"/persons/performed_by/name", R"("test")"}}, "P06", k_minor},
        {"one person in all roles",
         {{"/persons/performed_by/name", R"("Head of laboratory")"},
          {"/persons/reviewed_by/name", R"("HEAD OF LABORATORY")"}},
         "P07",
         k_major},
        {"nobody who performed or reviewed",
         {{"/persons/performed_by", ""}, {"/persons/reviewed_by", ""}},
         "P06",
         k_major},
        {"authorised since never", {{"/persons/authorised_by/authorised_from", ""}}, "P09", k_minor},
        {"authorised since tomorrow", {{"/persons/authorised_by/authorised_from", R"("2026-11-21")"}}, "P03"},
        {"authorised until before", {{"/persons/authorised_by/authorised_to", R"("2025-01-01")"}}, "P03"},
        {"authorised backwards",
         {{"/persons/performed_by/authorised_from", R"("2027-01-01")"},
          {"/persons/performed_by/authorised_to", R"("2026-01-01")"}},
         "P03"},
        {"not a signatory", {{"/persons/authorised_by/name", R"("Operator 3")"}}, "P03"},
        {"no signatories", {{"/accreditation/signatories", ""}}, "X10"},
        {"empty signatories", {{"/accreditation/signatories", "[]"}}, "X10"},
        {"signatory unknown", {{"/accreditation/signatories", R"(["unknown"])"}}, "X10"},
        // --- dates ---
        {"year one", {{"/dates/issued", R"("0001-01-01")"}}, k_refused},
        {"day 30 of February", {{"/dates/issued", R"("2026-02-30")"}}, k_refused},
        {"a date in words", {{"/dates/issued", R"("today")"}}, k_refused},
        {"no date of issue", {{"/dates/issued", ""}}, "R07-j"},
        {"no date of work", {{"/dates/performed_from", ""}, {"/dates/performed_to", ""}}, "R07-i"},
        {"no date of authorisation", {{"/dates/authorised", ""}}, "P10", k_major},
        {"received after the work", {{"/dates/received", R"("2026-11-20")"}}, "P05"},
        {"issued before the work", {{"/dates/issued", R"("2026-11-01")"}}, "P05"},
        {"authorised before the work", {{"/dates/authorised", R"("2026-11-01")"}}, "P05"},
        {"ended before it began", {{"/dates/performed_to", R"("2026-11-01")"}}, "P05"},
        {"performed over ten years",
         {{"/dates/performed_from", R"("2016-11-18")"}, {"/dates/received", R"("2016-11-16")"}},
         "P11",
         k_major},
        {"issued years after the work",
         {{"/dates/issued", R"("2029-11-21")"}, {"/dates/authorised", R"("2029-11-20")"}},
         "P11",
         k_major},
        {"received years before the work", {{"/dates/received", R"("2001-01-01")"}}, "P11", k_major},
        {"before the standard",
         {{"/dates",
           R"({"received": "1999-01-01", "performed_from": "1999-01-01", "authorised": "1999-01-01", "issued": "1999-01-01"})"}},
         "P11"},
        {"recalibration before issue",
         {{"/recalibration_date", R"("2026-01-01")"}, {"/recalibration_agreement", R"("Contract 88-2026, 5")"}},
         "R08"},
        {"recalibration on the day of issue",
         {{"/recalibration_date", R"("2026-11-21")"}, {"/recalibration_agreement", R"("Contract 88-2026, 5")"}},
         "R08"},
        {"recalibration without agreement", {{"/recalibration_date", R"("2028-11-21")"}}, "R08"},
        {"recalibration agreed nowhere",
         {{"/recalibration_date", R"("2028-11-21")"}, {"/recalibration_agreement", R"("see above")"}},
         "R08"},
        {"version of the method of tomorrow", {{"/method/valid_from", R"("2026-11-19")"}}, "P08"},
        {"version of the method of yesterday", {{"/method/valid_to", R"("2026-11-18")"}}, "P08"},
        {"version of the method backwards",
         {{"/method/valid_from", R"("2027-01-01")"}, {"/method/valid_to", R"("2020-01-01")"}},
         "P08"},
        // --- standards ---
        {"no standards", {{"/standards", "[]"}}, "R07-4c"},
        {"standard without date", {{"/standards/0/calibrated", ""}}, "R07-4c"},
        {"standard without certificate", {{"/standards/0/certificate", R"("none")"}}, "R07-4c"},
        {"standard without identification", {{"/standards/0/identification", ""}}, "R07-4c"},
        {"standard calibrated by nobody", {{"/standards/0/issuer", R"("unbekannt")"}}, "R07-4c"},
        {"standard named standard", {{"/standards/0/name", R"("standard")"}}, "R07-4c", k_major},
        {"standard without validity", {{"/standards/0/valid_to", ""}}, "T05", k_major},
        {"standard of 1990", {{"/standards/0/valid_to", ""}, {"/standards/0/calibrated", R"("1990-03-02")"}}, "T05"},
        {"standard valid for a century", {{"/standards/0/valid_to", R"("2126-03-02")"}}, "T05", k_major},
        {"standard expired", {{"/standards/0/valid_to", R"("2026-11-01")"}}, "T01"},
        {"standard of tomorrow", {{"/standards/0/calibrated", R"("2026-11-19")"}}, "T02"},
        {"standard without U", {{"/standards/0/U", ""}}, "T04"},
        {"standard with U of 0", {{"/standards/0/U", "0"}}, k_refused},
        {"standard with U below 0", {{"/standards/0/U", "-1"}}, k_refused},
        {"standard with k below 1", {{"/standards/0/k", "0.1"}}, k_refused},
        {"standard without unit", {{"/standards/0/unit", ""}}, k_refused},
        {"standard without k", {{"/standards/0/k", ""}}, "T04", k_major},
        {"standard worse than the result", {{"/standards/0/U", "7500"}}, "T07", k_major},
        {"standard worse than the result in another unit",
         {{"/standards/0/U", "1"}, {"/standards/0/unit", R"("mm")"}},
         "T07",
         k_major},
        {"standard certified by this certificate", {{"/standards/0/certificate", R"("EX 2026 0042")"}}, "T08"},
        {"standard that is the item", {{"/standards/0/identification", R"("SN-1001")"}}, "T08"},
        {"standard that is the item under its other name", {{"/standards/0/identification", R"("INV-55")"}}, "T08"},
        {"one certificate for two standards", {{"/standards/1/certificate", R"("NMI-2026-0117")"}}, "T08", k_major},
        {"one standard twice", {{"/standards/1/identification", R"("STD 017")"}}, "T08", k_major},
        {"national institute that is the laboratory",
         {{"/standards/0/issuer", R"("Example Calibration Laboratory")"}},
         "T08",
         k_major},
        {"standards of other work",
         {{"/standards/0/identification", R"("VM-1")"},
          {"/standards/0/certificate", R"("V-77")"},
          {"/standards/0/name", R"("Voltmeter")"},
          {"/standards/1/identification", R"("VM-2")"},
          {"/standards/1/certificate", R"("V-78")"},
          {"/standards/1/name", R"("Shunt")"}},
         "T06",
         k_major},
        {"one standard of other work",
         {{"/standards/1/identification", R"("VM-2")"},
          {"/standards/1/certificate", R"("V-78")"},
          {"/standards/1/name", R"("Shunt")"}},
         "T06",
         k_minor},
        {"budget without sources",
         {{"job:/inputs/l_s/source", ""},
          {"job:/inputs/d/components/1/source", ""},
          {"job:/inputs/d/components/2/source", ""}},
         "T06",
         k_major},
        {"standard without route", {{"/standards/0/route", ""}}, "T03"},
        {"route by evidence without evidence",
         {{"/standards/0/route", R"("3b")"}, {"/standards/0/evidence", R"("n/a")"}},
         "T03"},
        {"accredited laboratory without number", {{"/standards/1/issuer_accreditation", R"("unknown")"}}, "T03"},
        {"accredited laboratory of zeros", {{"/standards/1/issuer_accreditation", R"("0000")"}}, "T03"},
        {"route that there is not", {{"/standards/0/route", R"("9")"}}, k_refused},
        // --- conditions ---
        {"no conditions", {{"/conditions", "[]"}}, "R07-4b"},
        {"condition without name", {{"/conditions/0/quantity", R"("unknown")"}}, "R07-4b"},
        {"below absolute zero",
         {{"/conditions/0/minimum", "-300"}, {"/conditions/0/lower_limit", ""}, {"/conditions/0/upper_limit", ""}},
         "E02"},
        {"below absolute zero without kind",
         {{"/conditions/0", R"({"quantity": "Temperature", "minimum": -500, "maximum": 20, "unit": "degF"})"}},
         "E02"},
        {"zero kelvin",
         {{"/conditions/0",
           R"({"quantity": "Temperature", "kind": "temperature", "minimum": 0, "maximum": 293, "unit": "K"})"}},
         "E02"},
        {"temperature in metres",
         {{"/conditions/0",
           R"({"quantity": "Temperature", "kind": "temperature", "minimum": 20, "maximum": 20, "unit": "m"})"}},
         "E02"},
        {"humidity of 150 %",
         {{"/conditions/-",
           R"({"quantity": "Relative humidity", "kind": "humidity", "minimum": 40, "maximum": 150, "unit": "percent"})"}},
         "E02"},
        {"humidity below 0",
         {{"/conditions/-", R"({"quantity": "Humedad relativa", "minimum": -4, "maximum": 50, "unit": "percent"})"}},
         "E02"},
        {"pressure below 0",
         {{"/conditions/-",
           R"({"quantity": "Air pressure", "kind": "pressure", "minimum": -1013, "maximum": 1013, "unit": "hPa"})"}},
         "E02"},
        {"no pressure at all",
         {{"/conditions/-", R"({"quantity": "Luftdruck", "minimum": 0, "maximum": 0, "unit": "hPa"})"}},
         "E02"},
        {"conditions backwards", {{"/conditions/0/minimum", "30"}}, k_refused},
        {"broken limit", {{"/conditions/0/maximum", "25"}}, "E01"},
        {"broken limit, see above",
         {{"/conditions/0/maximum", "25"}, {"/method/no_deviations", ""}, {"/method/deviations", R"(["see above"])"}},
         "E01"},
        {"broken limit, one word",
         {{"/conditions/0/maximum", "25"}, {"/method/no_deviations", ""}, {"/method/deviations", R"(["warm"])"}},
         "E01"},
        {"deviations siehe oben",
         {{"/method/no_deviations", ""}, {"/method/deviations", R"(["s. o.", "siehe oben"])"}},
         "R07-n",
         k_major},
        {"nothing said of deviations", {{"/method/no_deviations", ""}}, "R07-n", k_major},
        {"deviations and none", {{"/method/deviations", R"(["Only once measured."])"}}, k_refused},
        {"adjusted or not", {{"/adjustment", ""}}, "R07-4d"},
        {"adjusted, before unknown", {{"/adjustment", R"({"adjusted": true, "as_found": "unknown"})"}}, "R07-4d"},
        // --- scope and capability ---
        {"capability of 99.99 %", {{"/accreditation/scope/0/capability/coverage_probability", "0.9999"}}, k_refused},
        {"capability of 68 %", {{"/accreditation/scope/0/capability/coverage_probability", "0.68"}}, k_refused},
        {"capability of 99 %", {{"/accreditation/scope/0/capability/coverage_probability", "0.99"}}, k_refused},
        {"capability with something taken away",
         {{"/accreditation/scope/0/capability/expression", R"("Q[50, 0.5*L]-55.9")"}},
         "X05"},
        {"capability with a little taken away",
         {{"/accreditation/scope/0/capability/expression", R"("Q[50, 0.5*L]-10")"}},
         "X14",
         k_minor},
        {"capability of nearly nothing",
         {{"/accreditation/scope/0/capability", R"({"form": "value", "unit": "nm", "U": 1e-9})"}},
         "X14",
         k_major},
        {"capability below every reference",
         {{"/accreditation/scope/0/capability/expression", R"("1e-4*L")"}},
         "X14",
         k_major},
        {"capability of 0",
         {{"/accreditation/scope/0/capability", R"({"form": "value", "unit": "nm", "U": 0})"}},
         k_refused},
        {"capability below 0",
         {{"/accreditation/scope/0/capability", R"({"form": "value", "unit": "nm", "U": -5})"}},
         k_refused},
        {"open capability", {{"/accreditation/scope/0/capability/expression", R"("< 50")"}}, k_refused},
        {"capability in another unit", {{"/accreditation/scope/0/capability/unit", R"("V")"}}, "X02"},
        {"no range",
         {{"/accreditation/scope/0/ranges", ""},
          {"/accreditation/scope/0/capability", R"({"form": "value", "unit": "nm", "U": 50})"}},
         "X11",
         k_major},
        {"no range of a function", {{"/accreditation/scope/0/ranges", "[]"}}, "X11", k_major},
        {"range of another place",
         {{"/accreditation/scope/0/ranges/0/low", "100"}, {"/accreditation/scope/0/ranges/0/high", "500"}},
         "X02"},
        {"range backwards", {{"/accreditation/scope/0/ranges/0/low", "1000"}}, k_refused},
        {"range on a number of one's own, 5 m",
         {{"/accreditation/scope/0/ranges/0",
           R"({"argument": {"name": "L", "unit": "mm", "of": "nominal"}, "low": 0.5, "high": 100})"},
          {"/parameters", R"([{"name": "nominal", "unit": "mm", "value": 50}])"},
          {"/accreditation/scope/0/ranges/0/high", "51"},
          {"job:/inputs/l_s/value", "5000000000"},
          {"/specifications", "[]"}},
         "X12"},
        {"range on a number of one's own, smaller",
         {{"/accreditation/scope/0/ranges/0",
           R"({"argument": {"name": "L", "unit": "mm", "of": "nominal"}, "low": 60, "high": 100})"},
          {"/parameters", R"([{"name": "nominal", "unit": "mm", "value": 80}])"}},
         "X12",
         k_minor},
        {"range of another quantity",
         {{"/accreditation/scope/0/ranges/0",
           R"({"argument": {"name": "f", "unit": "Hz", "of": "f"}, "low": 1, "high": 100})"},
          {"/parameters", R"([{"name": "f", "unit": "Hz", "value": 50}])"}},
         "X11",
         k_major},
        {"entry for everything", {{"/accreditation/scope/0/results", R"(["*"])"}}, k_refused},
        {"entry for nothing", {{"/accreditation/scope/0/results", "[]"}}, k_refused},
        {"entry without measurand", {{"/accreditation/scope/0/measurand", R"("any")"}}, "X13", k_minor},
        {"no scope", {{"/accreditation/scope", "[]"}}, "X02"},
        {"another method", {{"/method/identification", R"("CP-99")"}}, "X02"},
        {"another place",
         {{"/place", R"({"kind": "customer_site", "address": {"lines": ["Sample Road 2", "54321 Sample Town"]}})"}},
         "X02"},
        {"scope without validity", {{"/accreditation/valid_from", ""}, {"/accreditation/valid_to", ""}}, "X09"},
        {"scope without end", {{"/accreditation/valid_to", ""}}, "X09", k_major},
        {"scope without beginning", {{"/accreditation/valid_from", ""}}, "X09", k_major},
        {"scope backwards",
         {{"/accreditation/valid_from", R"("2029-12-31")"}, {"/accreditation/valid_to", R"("2025-01-01")"}},
         "X09"},
        {"scope for ever", {{"/accreditation/valid_to", R"("9999-12-31")"}}, "X09", k_major},
        {"scope expired", {{"/accreditation/valid_to", R"("2026-11-19")"}}, "X04"},
        {"scope of tomorrow", {{"/accreditation/valid_from", R"("2027-01-01")"}}, "X04"},
        {"accreditation without number", {{"/accreditation/number", R"("pending")"}}, "X08"},
        {"accreditation of zeros", {{"/accreditation/number", R"("000000")"}}, "X08"},
        {"accreditation without body", {{"/accreditation/body", R"("n.a.")"}}, "X08"},
        {"accreditation by another standard", {{"/accreditation/standard", R"("ISO 9001:2015")"}}, "X08"},
        {"accredited without accreditation", {{"/accreditation", ""}}, "X08"},
        {"symbol without image", {{"/accreditation/symbol_file", ""}}, "X15", k_minor},
        {"symbol that is no file", {{"/accreditation/symbol_file", R"("nowhere.png")"}}, k_refused},
        {"symbol that is no image", {{"/accreditation/symbol_file", R"("end_gauge.json")"}}, k_refused},
        {"opinion beside the symbol",
         {{"/opinions",
           R"([{"text": "The gauge is good.", "basis": "Experience of years", "author": {"name": "Head of laboratory"}}])"}},
         "X07"},
        {"99 %", {{"job:/coverage_probability", "0.99"}}, "K03"},
        {"68 %", {{"job:/coverage_probability", "0.6827"}}, "K03"},
        {"99.99 %", {{"job:/coverage_probability", "0.9999"}}, "K03"},
        {"no uncertainty at all",
         {{"job:/inputs/l_s", R"({"value": 50000623, "unit": "nm", "constant": true})"},
          {"job:/inputs/d", R"({"value": 215, "unit": "nm", "constant": true})"},
          {"job:/inputs/alpha_s", R"({"value": 11.5e-6, "unit": "1/K", "constant": true})"},
          {"job:/inputs/theta", R"({"value": -0.1, "unit": "K", "constant": true})"},
          {"job:/inputs/d_alpha", R"({"value": 0, "unit": "1/K", "constant": true})"},
          {"job:/inputs/d_theta", R"({"value": 0, "unit": "K", "constant": true})"}},
         "R07-4a"},
        // --- statements of conformity ---
        {"agreed after the work", {{"/specifications/0/agreed_on", R"("2026-11-20")"}}, "D02"},
        {"agreed with nobody", {{"/specifications/0/agreed_by", ""}}, "D02", k_major},
        {"agreed with unknown", {{"/specifications/0/agreed_by", R"("desconocido")"}}, "D02", k_major},
        {"agreed on no day", {{"/specifications/0/agreed_on", ""}}, "D02", k_major},
        {"prescribed by nobody",
         {{"/specifications/0/agreed_on", ""}, {"/specifications/0/rule/prescribed_by", R"("-")"}},
         "D02",
         k_major},
        {"without document", {{"/specifications/0/document", R"("see above")"}}, "D03", k_major},
        {"without edition", {{"/specifications/0/edition", R"("unknown")"}}, "D03", k_major},
        {"without limits", {{"/specifications/0/lower", ""}, {"/specifications/0/upper", ""}}, k_refused},
        {"limits backwards", {{"/specifications/0/lower", "60"}}, k_refused},
        {"rule that there is not", {{"/specifications/0/rule/id", R"("DR-99")"}}, k_refused},
        {"rule without its parameter", {{"/specifications/0/rule/id", R"("DR-04")"}}, k_refused},
        {"prescribed without saying by what", {{"/specifications/0/rule/id", R"("DR-12")"}}, "D10"},
        {"prescribed by n/a", {{"/specifications/0/rule", R"({"id": "DR-12", "prescribed_by": "N/A"})"}}, "D10"},
        {"rule of the customer without words",
         {{"/specifications/0/rule", R"({"id": "DR-13", "guard_factor": 0.0})"}, {"/specifications/0/agreement", ""}},
         "D10",
         k_major},
        {"passes by a measurement ten times too poor",
         {{"/specifications/0/rule/id", R"("DR-01")"},
          {"/specifications/0/lower", "50.000828"},
          {"/specifications/0/upper", "50.000848"}},
         "D08",
         k_major},
        {"accepts what does not conform",
         {{"/specifications/0/rule", R"({"id": "DR-11"})"}, {"/specifications/0/upper", "50.00080"}},
         "D08",
         k_major},
        {"no value can pass",
         {{"/specifications/0/lower", "50.000828"}, {"/specifications/0/upper", "50.000848"}},
         "D05",
         k_major},
        {"specification in volts", {{"/specifications/0/unit", R"("V")"}}, "D05", k_major},
        {"specification of a result that there is not", {{"/specifications/0/results", R"(["m"])"}}, "D07", k_major},
        {"specification of another laboratory's result",
         {{"/external_results", R"([{"results": ["l"], "provider": "Other Example Laboratory"}])"}},
         "D05",
         k_major},
        {"two specifications for one result",
         {{"/specifications/-",
           R"({"id": "second", "results": ["l"], "upper": 49, "unit": "mm", "document": "Drawing 1234", "edition": "B", "rule": {"id": "DR-01"}, "agreed_by": "Example Customer", "agreed_on": "2026-11-02"})"}},
         "D09",
         k_major},
        {"provider that is the laboratory",
         {{"/external_results", R"([{"results": ["l"], "provider": "Example Calibration Laboratory"}])"}},
         "R09",
         k_major},
        {"provider unknown", {{"/external_results", R"([{"results": ["l"], "provider": "unknown"}])"}}, "R07-p"},
        {"external result that there is not",
         {{"/external_results", R"([{"results": ["m"], "provider": "Other Example Laboratory"}])"}},
         "R09",
         k_major},
        // --- amendments and agreements ---
        {"amends itself",
         {{"/amendment",
           R"({"kind": "amended", "number": "EX-2026-0042", "reason": "Wrong name", "changes": ["Name"]})"}},
         "R12"},
        {"amends nothing",
         {{"/amendment", R"({"kind": "amended", "number": "none", "reason": "Wrong name", "changes": ["Name"]})"}},
         "R12"},
        {"amends without changes",
         {{"/amendment",
           R"({"kind": "replaced", "number": "EX-2026-0041", "reason": "Wrong name", "changes": ["-"]})"}},
         "R12"},
        {"amends without reason",
         {{"/amendment", R"({"kind": "replaced", "number": "EX-2026-0041", "reason": "x", "changes": ["Name"]})"}},
         "R12",
         k_major},
        {"simplified by nobody", {{"/simplified_agreement", R"("none")"}}, "R15", k_major},
        {"unknown key", {{"/trust_me", "true"}}, k_refused},
        {"status that there is not", {{"/status", R"("very accredited")"}}, k_refused},
        {"findings of one's own", {{"/findings", "[]"}}, k_refused},
        {"symbol of one's own", {{"/symbol", "true"}}, k_refused},
    };
    return all;
}

TEST_F(AttemptsToCheat, AreNotMadeByTheExample) {
    for (const Finding& f : issued({}).findings) {
        ADD_FAILURE() << f.id << " " << f.where << ": " << f.what;
    }
    EXPECT_TRUE(issued({}).symbol);
}

TEST_F(AttemptsToCheat, AreAllTold) {
    EXPECT_GE(attempts().size(), 150U);
    for (const Attempt& attempt : attempts()) {
        expect_told(attempt);
    }
}

/// Texts that stand for nothing, in the four languages.
const std::vector<const char*>& texts_for_nothing() {
    static const std::vector<const char*> texts = {"unknown",
                                                   "None",
                                                   "xxx",
                                                   "XXXXX",
                                                   "see above",
                                                   "n/a",
                                                   "N.A.",
                                                   "not stated",
                                                   "-",
                                                   "test",
                                                   "lorem",
                                                   "?",
                                                   "tbd",
                                                   "T.B.A.",
                                                   "to be defined",
                                                   "same as above",
                                                   "ditto",
                                                   "nil",
                                                   "null",
                                                   "undefined",
                                                   "not applicable",
                                                   "unbekannt",
                                                   "keine Angabe",
                                                   "k.A.",
                                                   "siehe oben",
                                                   "entfällt",
                                                   "nicht bekannt",
                                                   "ohne",
                                                   "desconocido",
                                                   "ninguna",
                                                   "no aplica",
                                                   "sin especificar",
                                                   "véase arriba",
                                                   "no consta",
                                                   "pendiente",
                                                   "不明",
                                                   "未知",
                                                   "無",
                                                   "不適用",
                                                   "見上",
                                                   "同上",
                                                   "待定",
                                                   "未提供",
                                                   "aaaa",
                                                   "...",
                                                   "_____",
                                                   "asdf",
                                                   "foo bar",
                                                   "***"};
    return texts;
}

TEST_F(AttemptsToCheat, NoTextForNothingIdentifiesAnything) {
    for (const char* field :
         {"/number", "/laboratory/name", "/customer/name", "/item/description", "/item/condition",
          "/method/identification", "/persons/authorised_by/name", "/accreditation/number", "/accreditation/body",
          "/standards/0/identification", "/standards/0/certificate", "/standards/0/issuer"}) {
        for (const char* text : texts_for_nothing()) {
            SCOPED_TRACE(std::string(field) + " " + text);
            const std::string quoted = json(text).dump();
            EXPECT_TRUE(issued({{field, quoted.c_str()}}).blocked);
        }
    }
}

}  // namespace
}  // namespace gumcert::app
