#include "audit/checklists.h"

#include <algorithm>

#include "audit/word_line.h"

namespace gumcert::audit {
namespace {

using enum Contributor;

std::vector<MethodChecklist> make_checklists() {
    return {
        {.method = "rotary_table_multilateration",
         .title = "Rotary table by multilateration",
         .words = {"multilateration", "rotary table", "rundtisch", "drehtisch"},
         .required = {{"calibration of the laser (wavelength)",
                       {},
                       {"laser", "wavelength", "wellenlange", "tracer", "interferometer"}},
                      {"refractive index of air", {refractive_index}, {}},
                      {"dead path", {dead_path}, {}},
                      {"coordinates of the fixture (CMM)",
                       {},
                       {"cmm", "kmg", "fixture", "vorrichtung", "coordinate", "koordinat"}},
                      {"temperature of the fixture and its expansion", {expansion, temperature}, {}},
                      {"repeatability of the table", {repeatability}, {}},
                      {"datum (centring and levelling)", {alignment}, {"datum", "zentrier"}},
                      {"form of the spheres", {target_form}, {}},
                      {"parameters and residuals of the adjustment", {fit}, {}}}},
        {.method = "end_gauge_comparison",
         .title = "End gauge by comparison",
         .words = {"end gauge", "gauge block", "gage block", "endmass", "parallelendmass", "gb comparison"},
         .required = {{"length of the reference gauge", {reference}, {}},
                      {"difference measured by the comparator",
                       {repeatability, item_resolution},
                       {"comparator", "komparator", "difference", "differenz"}},
                      {"difference of temperatures", {temperature}, {}},
                      {"thermal expansion coefficients", {expansion}, {}},
                      {"central length (place of the contact)",
                       {alignment, target_form},
                       {"contact", "central length", "mittenmass", "antast", "variation in length"}}}},
        {.method = "multimeter",
         .title = "Digital multimeter",
         .words = {"multimeter", "voltmeter", "ammeter", "ohmmeter", "dmm ", "calibrator", "spannungsmess"},
         .required = {{"calibration of the source", {reference}, {}},
                      {"leads, contacts and thermal voltages",
                       {},
                       {"lead", "leitung", "contact", "kontakt", "emf ", "thermospannung", "connection", "loading",
                        "pick up", "burden"}}}},
        {.method = "thermometer",
         .title = "Thermometer (Pt100)",
         .words = {"thermometer", "pt100", "pt 100", "thermocouple", "thermoelement", "temperature sensor",
                   "temperatursensor", "temperaturfuhler"},
         .required =
             {{"calibration of the reference thermometer", {reference}, {}},
              {"homogeneity of the bath or block", {}, {"homogen", "inhomogen", "uniform", "gradient", "*homogenitat"}},
              {"stability of the bath or block",
               {},
               {"stabil", "instabil", "*stabilitat", "fluctuation", "schwankung"}},
              {"immersion and heat conduction", {}, {"immersion", "eintauch", "conduction", "warmeableit", "stem"}},
              {"self-heating",
               {},
               {"self heat", "selfheat", "eigenerwarm", "selbsterwarm", "measuring current", "messstrom"}}}},
        {.method = "torque_wrench",
         .title = "Torque wrench",
         .words = {"torque", "drehmoment"},
         .required = {{"calibration of the torque transducer", {reference}, {}},
                      {"reproducibility of the torque tool", {reproducibility}, {}},
                      {"interface of the output drive", {}, {"drive", "interface", "abtrieb", "vierkant", "adapter"}},
                      {"point of the load application",
                       {},
                       {"load point", "loading point", "lever", "krafteinleit", "hebel", "force application",
                        "lever length"}}}},
        {.method = "weights",
         .title = "Weights",
         .words = {"weight ", "weights", "gewicht", "mass standard", "massenormal"},
         .required = {{"mass of the reference weight", {reference}, {}},
                      {"air buoyancy", {}, {"buoyancy", "auftrieb", "air density", "luftdichte"}},
                      {"weighing process", {repeatability}, {}},
                      {"balance (eccentricity, sensitivity, linearity)",
                       {},
                       {"eccentric", "exzentri", "sensitivity", "empfindlich", "linear", "balance", "waage"}}}},
        {.method = "caliper_micrometer",
         .title = "Caliper or micrometer",
         .words = {"caliper", "calliper", "micrometer", "messschieber", "schieblehre", "messschraube", "mikrometer"},
         .required = {{"length of the gauge blocks", {reference}, {}},
                      {"difference of temperatures", {temperature}, {}},
                      {"thermal expansion coefficients", {expansion}, {}},
                      {"flatness and parallelism of the measuring faces, Abbe offset",
                       {target_form, alignment},
                       {"mechanical effect", "mechanisch"}}}},
        {.method = "dial_indicator",
         .title = "Dial indicator",
         .words = {"dial indicator", "dial gauge", "messuhr", "feinzeiger", "fuhlhebel", "test indicator"},
         .required = {{"calibration of the measuring head or bench", {reference}, {}},
                      {"alignment to the axis of measurement", {alignment}, {}},
                      {"temperature and expansion", {temperature, expansion}, {}},
                      {"hysteresis", {}, {"hysteres", "umkehr", "reversal"}}}},
        {.method = "cmm_fixture",
         .title = "Measurement of a fixture by CMM",
         .words = {"cmm ", "kmg ", "coordinate measuring", "koordinatenmess"},
         .required = {{"calibration of the CMM (length measurement error)", {reference}, {"cmm", "kmg"}},
                      {"probing", {}, {"prob", "antast", "tast"}},
                      {"temperature of the workpiece and its expansion", {temperature, expansion}, {}},
                      {"clamping and datum of the workpiece", {alignment}, {}},
                      {"form of the probed surfaces", {target_form}, {}}}},
    };
}

}  // namespace

std::span<const MethodChecklist> method_checklists() {
    static const std::vector<MethodChecklist> k_checklists = make_checklists();
    return k_checklists;
}

std::span<const RequiredContributor> minimum_contributors() {
    static const std::vector<RequiredContributor> k_minimum{
        {"repeatability", {repeatability}, {}},
        {"resolution of the item", {item_resolution}, {}},
        {"reproducibility", {reproducibility}, {}},
        {"uncertainty of the reference standard", {reference}, {}},
        {"stability of the reference standard", {reference_drift}, {}},
        {"environment", {temperature, expansion, refractive_index, environment}, {}},
    };
    return k_minimum;
}

const MethodChecklist* checklist_of(std::string_view method) {
    const std::span<const MethodChecklist> all = method_checklists();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [method](const MethodChecklist& checklist) { return checklist.method == method; });
    return found == all.end() ? nullptr : &*found;
}

std::string method_in_title(std::string_view title) {
    const WordLine words(title);
    for (const MethodChecklist& checklist : method_checklists()) {
        if (words.has_any(checklist.words)) {
            return std::string(checklist.method);
        }
    }
    return "";
}

bool stands_for(const AuditedRow& row, const RequiredContributor& required) {
    if (std::find(required.by.begin(), required.by.end(), row.contributor) != required.by.end()) {
        return true;
    }
    return WordLine(row.quantity).has_any(required.words) || WordLine(row.comment).has_any(required.words) ||
           WordLine(row.source).has_any(required.words);
}

}  // namespace gumcert::audit
