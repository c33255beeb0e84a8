#pragma once

#include <string>

#include "certificate/certificate_data.h"

namespace gumcert::test {

/// A text in the two languages of the sample.
inline certificate::LocalisedText in_two_languages(const std::string& english, const std::string& german) {
    certificate::LocalisedText text;
    text.by_language = {{"en", english}, {"de", german}};
    return text;
}

/// A capability of one value over the whole range.
inline certificate::Capability capability_of_one_value(double U, const std::string& unit) {
    certificate::Capability capability;
    capability.form = "value";
    capability.unit = unit;
    capability.U = U;
    return capability;
}

/// The scope covers what sample_record.h and sample_budget_record.h report: the length "l" of JCGM 100:2008, H.1, and
/// the rotary table about A. Not the ranges ("range_EXA"), so that something is outside of the accreditation.
inline certificate::Accreditation sample_accreditation() {
    certificate::Accreditation a;
    a.body = in_two_languages("Example Accreditation Body", "Beispiel-Akkreditierungsstelle");
    a.number = "EX-0000";
    a.valid_from = "2025-01-01";
    a.valid_to = "2029-12-31";
    a.symbol_file = "symbol.png";  // a square of 16 pixels with a diagonal
    a.symbol_sha256 = "c93bfcd0eafc9fdbc018727834c26276adb680dcc07adc98c4964c8c82804a02";
    a.symbol_media_type = "image/png";
    a.symbol_base64 =
        "iVBORw0KGgoAAAANSUhEUgAAABAAAAAQCAAAAAA6mKC9AAAAOElEQVR42m3Pxw0AMAgEwe2/aecAa9+PkUjwpsT0GkOS2YEhyJ6J4cjdimFJ"
        "vAvDkHw5hiaf35wKVgC1S7XsytgAAAAASUVORK5CYII=";

    certificate::ScopeEntry length;
    length.id = "L1";
    length.measurand = in_two_languages("Central length of end gauges", "Mittenmaß von Endmaßen");
    length.results = {"l"};
    length.methods = {"CP-01"};
    length.places = {"laboratory"};
    length.ranges = {{.argument = {.name = "L", .unit = "mm", .of = "value"}, .low = 0.5, .high = 100.0}};
    length.capability.form = "function";
    length.capability.unit = "nm";
    length.capability.arguments = {{.name = "L", .unit = "mm", .of = "value"}};
    length.capability.expression = "Q[50, 0.5*L]";

    certificate::ScopeEntry linear;
    linear.id = "R1";
    linear.measurand = in_two_languages("Linear error motions of rotary axes", "Translatorische Bewegungsabweichungen");
    linear.results = {"EXA", "EYA", "EZA", "O_*"};
    linear.methods = {"CP-01"};
    linear.places = {"laboratory", "customer_site"};
    linear.ranges = {{.argument = {.name = "angle", .unit = "deg", .of = "argument"}, .low = 0.0, .high = 360.0}};
    linear.capability = capability_of_one_value(0.2, "um");

    certificate::ScopeEntry angular = linear;
    angular.id = "R2";
    angular.measurand = in_two_languages("Angular error motions of rotary axes", "Rotatorische Bewegungsabweichungen");
    angular.results = {"EAA", "EBA", "ECA", "S_*"};
    angular.capability = capability_of_one_value(0.2, "arcsec");

    a.scope = {length, linear, angular};
    a.signatories = {"Head of laboratory"};
    return a;
}

inline certificate::StandardUsed sample_standard() {
    certificate::StandardUsed s;
    s.name = in_two_languages("Laser interferometer", "Laserinterferometer");
    s.identification = "STD-017";
    s.certificate = "NMI-2026-0117";
    s.issuer = "Example National Metrology Institute";
    s.issuer_accreditation = "NMI";
    s.route = "1";
    s.calibrated = "2026-03-02";
    s.valid_to = "2028-03-01";
    s.role = "reference";
    s.U = 0.025;
    s.k = 2.0;
    s.unit = "um";
    s.sha256 = std::string(64, 'a');
    return s;
}

inline certificate::Condition sample_temperature() {
    certificate::Condition c;
    c.quantity = in_two_languages("Air temperature", "Lufttemperatur");
    c.kind = "temperature";
    c.minimum = 19.8;
    c.maximum = 20.3;
    c.unit = "degC";
    c.U = 0.1;
    c.sensor = "T-04";
    c.lower_limit = 19.0;
    c.upper_limit = 21.0;
    return c;
}

inline certificate::AgreedSpecification sample_specification(const std::string& id, const std::string& result,
                                                             double lower, double upper, const std::string& unit) {
    certificate::AgreedSpecification s;
    s.id = id;
    s.results = {result};
    s.lower = lower;
    s.upper = upper;
    s.unit = unit;
    s.document = "Drawing 1234";
    s.edition = "B";
    s.clause = "3.2";
    s.rule.id = "DR-03";
    s.agreed_by = "Example Customer, purchasing";
    s.agreed_on = "2026-11-02";
    s.agreement = "Contract 88-2026";
    return s;
}

inline certificate::Person sample_person(const std::string& name, const std::string& english,
                                         const std::string& german) {
    certificate::Person p;
    p.name = name;
    p.function = in_two_languages(english, german);
    return p;
}

/// Not part of the sample, because most profiles do not let it stand beside the symbol.
inline certificate::Opinion sample_opinion() {
    certificate::Opinion o;
    o.text = in_two_languages("The item is suited for use as a working standard.",
                              "Der Gegenstand eignet sich als Gebrauchsnormal.");
    o.basis = in_two_languages("Results of this certificate and of 2024", "Ergebnisse dieses Scheins und von 2024");
    o.author = sample_person("Head of laboratory", "Head of laboratory", "Laborleitung");
    return o;
}

/// Complete data of an accredited certificate in English and German; with it sample_record() and
/// sample_budget_record() make certificates that pass every gate apart from what lies outside of the scope. No
/// amendment, no opinion.
inline certificate::CertificateData sample_certificate_data() {
    certificate::CertificateData d;
    d.status = "accredited";
    d.number = "EX-2026-0042";
    d.languages = {"en", "de"};
    d.profile = "ilac";
    d.laboratory.name = in_two_languages("Example Calibration Laboratory", "Beispiel-Kalibrierlaboratorium");
    d.laboratory.address = {.lines = {"Example Street 1", "12345 Example Town"}, .country = "DE"};
    d.laboratory.email = "calibration@example.org";
    d.laboratory.telephone = "+49 0000 0000";
    d.laboratory.web = "https://example.org";
    d.laboratory.code = "EX-K";
    d.accreditation = sample_accreditation();
    d.customer.name = "Example Customer";
    d.customer.address = {.lines = {"Sample Road 2", "54321 Sample Town"}, .country = "AT"};
    d.customer.contact = "Quality department";
    d.customer.email = "quality@example.com";
    d.customer.order = "PO-2026-77";
    d.item.description = in_two_languages("Item under calibration", "Kalibriergegenstand");
    d.item.manufacturer = "Example Works";
    d.item.type = "EW 50";
    d.item.serial_number = "SN-1001";
    d.item.identification = "INV-55";
    d.item.condition = in_two_languages("No damage seen", "Keine Beschädigung erkennbar");
    d.item.owner = "Example Customer";
    d.item.stated_by_customer = {"identification"};
    d.place.description = in_two_languages("Measuring room 2", "Messraum 2");
    d.dates = {.received = "2026-11-16",
               .performed_from = "2026-11-18",
               .performed_to = "2026-11-19",
               .authorised = "2026-11-20",
               .issued = "2026-11-21"};
    d.method.identification = "CP-01";
    d.method.version = "4";
    d.method.title = in_two_languages("Calibration by laser interferometry", "Kalibrierung mit Laserinterferometer");
    d.method.description = in_two_languages("Comparison with the wavelength of a stabilised laser in air.",
                                            "Vergleich mit der Wellenlänge eines stabilisierten Lasers in Luft.");
    d.method.standard = "ISO 230-7:2015";
    d.method.valid_from = "2024-05-01";
    d.method.no_deviations = true;
    d.standards = {sample_standard()};
    d.conditions = {sample_temperature()};
    d.persons.performed_by = sample_person("Operator", "Calibration engineer", "Messtechniker");
    d.persons.reviewed_by = sample_person("Reviewer", "Technical reviewer", "Prüfer");
    d.persons.authorised_by = sample_person("Head of laboratory", "Head of laboratory", "Laborleitung");
    d.persons.authorised_by->authorised_from = "2024-01-01";
    d.specifications = {sample_specification("length", "l", 49999000.0, 50001000.0, "nm"),
                        sample_specification("axial", "EAA", -10.0, 10.0, "arcsec")};
    d.remarks = {in_two_languages("The item was cleaned before the calibration.",
                                  "Der Gegenstand wurde vor der Kalibrierung gereinigt.")};
    d.adjustment = certificate::Adjustment{.adjusted = false, .as_found = {}};
    return d;
}

}  // namespace gumcert::test
