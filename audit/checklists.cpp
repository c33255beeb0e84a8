#include "audit/checklists.h"

#include <algorithm>

#include "audit/row_meaning.h"
#include "audit/word_line.h"

namespace gumcert::audit {
namespace {

using enum Contributor;

/// Of a mass: its buoyancy, or a density from which it follows.
const std::vector<std::string_view> k_of_buoyancy = {"buoyancy",  "*auftrieb", "air density", "luftdichte", "density",
                                                     "densities", "dichte",    "*dichte ",    "densidad",   "*密度"};

std::vector<MethodChecklist> make_checklists() {
    return {
        {.method = "rotary_table_multilateration",
         .title = say("Rotary table by multilateration"),
         .source = "ISO 230-7:2015, Test code for machine tools, Part 7: Geometric accuracy of axes of rotation",
         // A rotary table is calibrated by other methods as well: with a polygon and an autocollimator, by circle closure.
         .words = {"multilaterat", "laser tracer", "lasertracer", "tracking interferometer"},
         .required = {{say("calibration of the laser (wavelength)"),
                       {},
                       {"laser", "wavelength", "wellenlange", "tracer", "interferometer"}},
                      {say("refractive index of air"), {refractive_index}, {}},
                      {say("dead path"), {dead_path}, {}},
                      {say("coordinates of the fixture (CMM)"),
                       {},
                       {"cmm", "kmg", "fixture", "vorrichtung", "coordinate", "koordinat"}},
                      {say("temperature of the fixture and its expansion"), {expansion, temperature}, {}},
                      {say("repeatability of the table"), {repeatability}, {}},
                      {say("datum (centring and levelling)"), {alignment}, {"datum", "zentrier"}},
                      {say("form of the spheres"), {target_form}, {}},
                      {say("parameters and residuals of the adjustment"), {fit}, {}}}},
        {.method = "end_gauge_comparison",
         .title = say("End gauge by comparison"),
         .source = "EA-4/02, Evaluation of the Uncertainty of Measurement in Calibration; ISO 3650, Length standards, "
                   "Gauge blocks",
         .words = {"end gauge", "gauge block", "gage block", "endmass", "parallelendmass", "gb comparison"},
         .required = {{say("length of the reference gauge"), {reference}, {}},
                      {say("difference measured by the comparator"),
                       {repeatability, item_resolution},
                       {"comparator", "komparator", "difference", "differenz"}},
                      {say("difference of temperatures"), {temperature}, {}},
                      {say("thermal expansion coefficients"), {expansion}, {}},
                      {say("central length (place of the contact)"),
                       {alignment, target_form},
                       {"contact", "central length", "mittenmass", "antast", "variation in length"}}}},
        {.method = "multimeter",
         .title = say("Digital multimeter"),
         .source = "EURAMET cg-15, Guidelines on the Calibration of Digital Multimeters; EA-4/02",
         .words = {"multimeter", "voltmeter", "ammeter", "ohmmeter", "dmm ", "multifunction calibrator",
                   "multi function calibrator", "multiproduct calibrator", "multi product calibrator",
                   "voltage calibrator", "current calibrator", "electrical calibrator", "multifunktionskalibrator",
                   "spannungskalibrator", "spannungsmess"},
         .required = {{say("calibration of the source"), {reference}, {}},
                      {say("leads, contacts and thermal voltages"),
                       {},
                       {"lead", "leitung", "contact", "kontakt", "emf ", "thermospannung", "connection", "loading",
                        "pick up", "burden"}}}},
        {.method = "thermometer",
         .title = say("Thermometer (Pt100)"),
         .source = "DKD-R 5-1, Kalibrierung von Widerstandsthermometern; EURAMET cg-13, Guidelines on the Calibration "
                   "of Temperature Block Calibrators",
         .words = {"thermometer", "*widerstandsthermometer", "pt100", "pt 100", "temperature sensor",
                   "temperatursensor", "temperaturfuhler"},
         .required = {{say("calibration of the reference thermometer"), {reference}, {}},
                      {say("homogeneity of the bath or block"),
                       {},
                       {"homogen", "inhomogen", "uniform", "gradient", "*homogenitat"}},
                      {say("stability of the bath or block"),
                       {},
                       {"stabil", "instabil", "*stabilitat", "fluctuation", "schwankung"}},
                      {say("immersion and heat conduction"),
                       {},
                       {"immersion", "eintauch", "conduction", "warmeableit", "stem"}},
                      {say("self-heating"),
                       {},
                       {"self heat", "selfheat", "eigenerwarm", "selbsterwarm", "measuring current", "messstrom"}}},
         .not_with = {"thermocouple", "thermoelement", "radiation", "infrared", "infrarot", "*strahlung", "pyrometer",
                      "glass thermometer", "in glass", "*glasthermometer", "*flussigkeitsthermometer"}},
        {.method = "torque_wrench",
         .title = say("Torque wrench"),
         .source = "ISO 6789-2:2017, Hand torque tools, Part 2: Requirements for calibration and determination of "
                   "measurement uncertainty",
         .words = {"torque wrench", "torque tool", "torque screwdriver", "torque spanner", "hand torque",
                   "drehmomentschlussel", "drehmomentschraub", "drehmoment schlussel", "drehmoment schraub",
                   "drehmomentwerkzeug"},
         .required = {{say("calibration of the torque transducer"), {reference}, {}},
                      {say("reproducibility of the torque tool"), {reproducibility}, {}},
                      {say("interface of the output drive"),
                       {},
                       {"drive", "interface", "abtrieb", "vierkant", "adapter"}},
                      {say("point of the load application"),
                       {},
                       {"load point", "loading point", "load application", "lever", "krafteinleit", "hebel",
                        "force application", "lever length"}}}},
        {.method = "balance",
         .title = say("Weighing instrument (balance)"),
         .source = "EURAMET cg-18, Guidelines on the Calibration of Non-Automatic Weighing Instruments",
         .words = {"weighing instrument", "electronic balance", "analytical balance", "calibration of balance",
                   "calibration of a balance", "balance calibration", "balances", "*waage"},
         .required = {{say("mass of the test weights"), {reference}, {"test weight", "prufgewicht", "test load"}},
                      {say("resolution without and with load"),
                       {item_resolution},
                       {"rounding", "readability", "ziffernschritt", "teilungswert", "scale interval"}},
                      {say("repeatability"), {repeatability}, {}},
                      {say("eccentric loading"), {}, {"eccentric", "exzentri", "ecken"}},
                      {say("air buoyancy"), {}, k_of_buoyancy},
                      {say("convection and drift of the temperature"), {temperature}, {"convection", "konvektion"}}},
         .not_with = {"pressure", "*druck", "*wasserwaage", "current balance", "*stromwaage"}},
        {.method = "weights",
         .title = say("Weights"),
         .source = "OIML R 111-1, Weights of classes E1, E2, F1, F2, M1, M1-2, M2, M2-3 and M3; EA-4/02",
         .words = {"weight ", "weights", "gewicht", "mass standard", "massenormal"},
         .required = {{say("mass of the reference weight"), {reference}, {}},
                      {say("air buoyancy"), {}, k_of_buoyancy},
                      {say("weighing process"), {repeatability}, {"weighing", "*wagung", "wage", "abba", "aba "}},
                      {say("balance (eccentricity, sensitivity, linearity)"),
                       {},
                       {"eccentric", "exzentri", "sensitivity", "empfindlich", "linear", "balance", "waage"}}},
         .not_with = {"dead weight", "deadweight", "molecular", "atomic", "specific weight", "basis weight",
                      "spezifisch", "pressure", "*druck"}},
        {.method = "caliper_micrometer",
         .title = say("Caliper or micrometer"),
         .source = "EA-4/02, Evaluation of the Uncertainty of Measurement in Calibration; ISO 13385-1 (callipers); ISO "
                   "3611 (micrometers)",
         .words = {"caliper", "calliper", "micrometer", "messschieber", "schieblehre", "messschraube", "mikrometer"},
         .required = {{say("length of the gauge blocks"), {reference}, {}},
                      {say("difference of temperatures"), {temperature}, {}},
                      {say("thermal expansion coefficients"), {expansion}, {}},
                      {say("flatness and parallelism of the measuring faces, Abbe offset"),
                       {target_form, alignment},
                       {"mechanical effect", "mechanisch"}}},
         .not_with = {"stage micrometer", "brake"}},
        {.method = "dial_indicator",
         .title = say("Dial indicator"),
         .source = "ISO 463, Design and metrological characteristics of mechanical dial gauges",
         .words = {"dial indicator", "dial gauge", "messuhr", "feinzeiger", "fuhlhebel", "test indicator"},
         .required = {{say("calibration of the measuring head or bench"), {reference}, {}},
                      {say("alignment to the axis of measurement"), {alignment}, {}},
                      {say("temperature and expansion"), {temperature, expansion}, {}},
                      {say("hysteresis"), {}, {"hysteres", "umkehr", "reversal"}}}},
        {.method = "cmm_fixture",
         .title = say("Measurement of a fixture by CMM"),
         .source = "ISO 15530-3, Coordinate measuring machines (CMM), Technique for determining the uncertainty of "
                   "measurement, Part 3: Use of calibrated workpieces or measurement standards",
         .words = {"cmm ", "kmg ", "coordinate measuring", "koordinatenmess"},
         .required = {{say("calibration of the CMM (length measurement error)"), {reference}, {"cmm", "kmg"}},
                      {say("probing"), {}, {"prob", "antast", "tast"}},
                      {say("temperature of the workpiece and its expansion"), {temperature, expansion}, {}},
                      {say("clamping and datum of the workpiece"), {alignment}, {}},
                      {say("form of the probed surfaces"), {target_form}, {}}}},
        {.method = "pressure",
         .title = say("Pressure gauge or transducer"),
         .source = "EURAMET cg-17, Guidelines on the Calibration of Electromechanical and Mechanical Manometers",
         .words = {"pressure gauge", "pressure transducer", "pressure transmitter", "pressure calibrat",
                   "pressure sensor", "*manometer", "druckmess", "druckaufnehmer", "drucktransmitter"},
         .required = {{say("calibration of the pressure standard"), {reference}, {}},
                      {say("head of the pressure medium (difference of heights)"),
                       {},
                       {"head", "height", "hohen", "level", "hydrostat"}},
                      {say("zero point"), {}, {"zero", "nullpunkt"}},
                      {say("hysteresis"), {}, {"hysteres", "umkehr", "reversib"}},
                      {say("repeatability"), {repeatability}, {"reproduzier", "reproducib"}},
                      {say("temperature"), {temperature}, {}}},
         .not_with = {"sphygmo", "*blutdruck", "sound"}},
        {.method = "pipette",
         .title = say("Pipette, burette or dispenser (gravimetric)"),
         .source =
             "ISO 8655-6, Piston-operated volumetric apparatus, Part 6: Gravimetric reference measurement procedure; "
             "EURAMET cg-19, Guidelines on the Determination of Uncertainty in Gravimetric Volume Calibration",
         .words = {"*pipet", "buret", "bureta", "kolbenhub", "piston operated", "dispenser", "volumetric"},
         .required = {{say("weighing (balance)"), {reference}, {"balance", "waage", "weighing", "wagung", "mass"}},
                      {say("density and temperature of the water"),
                       {},
                       {"water", "wasser", "density of the liquid", "liquid", "flussigkeit"}},
                      {say("air buoyancy"),
                       {},
                       {"buoyancy", "*auftrieb", "air density", "luftdichte", "z factor", "z faktor"}},
                      {say("evaporation"), {}, {"evaporat", "verdunst"}},
                      {say("expansion of the device"), {expansion}, {}},
                      {say("repeatability (handling)"), {repeatability, reproducibility}, {"operator", "handling"}}},
         .not_with = {"flow", "durchfluss", "fuel"}},
        {.method = "oscilloscope",
         .title = say("Oscilloscope"),
         .source = "EURAMET cg-7, Calibration of Oscilloscopes",
         .words = {"oscilloscope", "oszilloskop"},
         .required = {{say("calibration of the calibrator"), {reference}, {}},
                      {say("mismatch and loading by the input"),
                       {},
                       {"mismatch", "fehlanpass", "loading", "impedance", "impedanz"}},
                      {say("resolution of the display or of the cursors"),
                       {item_resolution},
                       {"cursor", "quantis", "quantiz"}},
                      {say("noise and trigger jitter"), {repeatability}, {"noise", "rausch", "jitter", "trigger"}}}},
        {.method = "time_interval",
         .title = say("Stopwatch, timer or counter"),
         .source = "NIST Special Publication 960-12, Stopwatch and Timer Calibrations",
         .words = {"stopwatch", "stop watch", "stoppuhr", "timer", "frequency counter", "universal counter",
                   "frequenzzahler", "zeitmess"},
         .required = {{say("time base of the reference"),
                       {reference, reference_drift},
                       {"time base", "zeitbasis", "frequency standard"}},
                      {say("starting and stopping (reaction, trigger)"),
                       {},
                       {"reaction", "reaktion", "trigger", "start", "manual", "operator", "bediener"}},
                      {say("resolution"), {item_resolution}, {}},
                      {say("repeatability"), {repeatability}, {}}}},
        {.method = "hardness",
         .title = say("Hardness (testing machine or reference block)"),
         .source = "EURAMET cg-16, Guidelines on the Estimation of Uncertainty in Hardness Measurements; ISO 6506-2, "
                   "ISO 6507-2, ISO 6508-2",
         .words = {"hardness", "rockwell", "vickers", "brinell", "hartepruf", "hartemess", "hartevergleich"},
         .required = {{say("reference block"), {reference}, {"reference block", "hartevergleichsplatte", "crm"}},
                      {say("scatter and uniformity of the block"),
                       {repeatability},
                       {"uniform", "homogen", "*homogenitat"}},
                      {say("test force"), {}, {"force", "kraft"}},
                      {say("indenter"), {}, {"indenter", "eindringkorper", "diamond", "diamant"}},
                      {say("measurement of the indentation (length or depth)"),
                       {item_resolution, reference_resolution},
                       {"indentation", "eindruck", "depth", "diagonal", "microscope", "mikroskop"}}},
         .not_with = {"water", "wasser", "titration", "shore", "durometer", "irhd"}},
        {.method = "force",
         .title = say("Force transducer or testing machine"),
         .source =
             "ISO 376, Calibration of force-proving instruments; ISO 7500-1, Calibration and verification of static "
             "uniaxial testing machines; EURAMET cg-4, Uncertainty of Force Measurements",
         .words = {"force transducer", "force measur", "force proving", "testing machine", "load cell", "dynamometer",
                   "kraftmess", "kraftaufnehmer", "*prufmaschine"},
         .required = {{say("calibration of the force standard"), {reference}, {}},
                      {say("drift of the force standard"), {reference_drift}, {}},
                      {say("repeatability and reproducibility (mounting positions)"),
                       {repeatability, reproducibility},
                       {"rotation", "mounting", "einbaulage"}},
                      {say("reversibility"), {}, {"reversib", "hysteres", "umkehr"}},
                      {say("zero point"), {}, {"zero", "nullpunkt"}},
                      {say("resolution"), {item_resolution}, {}},
                      {say("temperature"), {temperature}, {}}},
         .not_with = {"torque", "drehmoment", "hardness", "*harte"}},
    };
}

/// What a name names one after the other: "Reproducibility (clamping, datum)", "Repeatability and resolution".
std::vector<std::string_view> parts_of_name(std::string_view name) {
    std::vector<std::string_view> parts;
    while (!name.empty()) {
        std::size_t end = name.find_first_of("(),;/+&"), next = end;
        for (const std::string_view between : {" and ", " und ", " incl", " inkl", " with ", " mit "}) {
            const std::size_t at = name.find(between);
            if (at < std::min(end, name.size())) {
                end = at;
                next = at + between.size() - 1;
            }
        }
        if (const std::string_view part = name.substr(0, end); part.find_first_not_of(' ') != std::string_view::npos) {
            parts.push_back(part);
        }
        name = end == std::string_view::npos ? std::string_view() : name.substr(next + 1);
    }
    return parts;
}

}  // namespace

std::span<const MethodChecklist> method_checklists() {
    static const std::vector<MethodChecklist> k_checklists = make_checklists();
    return k_checklists;
}

std::span<const RequiredContributor> minimum_contributors() {
    static const std::vector<RequiredContributor> k_minimum{
        {say("repeatability"), {repeatability}, {}},
        {say("resolution of the item"), {item_resolution}, {}},
        {say("reproducibility"), {reproducibility}, {}},
        {say("uncertainty of the reference standard"), {reference}, {}, true},
        {say("stability of the reference standard"), {reference_drift}, {}},
        {say("environment"), {temperature, expansion, refractive_index, environment}, {}},
    };
    return k_minimum;
}

const MethodChecklist* checklist_of(std::string_view method) {
    const std::span<const MethodChecklist> all = method_checklists();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [method](const MethodChecklist& checklist) { return checklist.method == method; });
    return found == all.end() ? nullptr : &*found;
}

std::string method_in_words(std::string_view method) {
    const MethodChecklist* const checklist = checklist_of(method);
    return checklist == nullptr ? std::string(method) : checklist->title.english();
}

std::string method_in_title(std::string_view title) {
    const WordLine words(title);
    for (const MethodChecklist& checklist : method_checklists()) {
        if (words.has_any(checklist.words) && !words.has_any(checklist.not_with)) {
            return std::string(checklist.method);
        }
    }
    return "";
}

bool names_material_measure(std::string_view title) {
    const WordLine words(title);
    const std::string method = method_in_title(title);
    const bool is_of_instrument =
        !method.empty() && method != "weights" && method != "end_gauge_comparison" && method != "cmm_fixture";
    return !is_of_instrument &&
           words.has_any({"weight ",
                          "weights ",
                          "gewicht",
                          "mass standard",
                          "massenormal",
                          "gauge block",
                          "gage block",
                          "endmass",
                          "parallelendmass",
                          "*endmass",
                          "length bar",
                          "ring gauge",
                          "plug gauge",
                          "setting ring",
                          "setting rod",
                          "thread gauge",
                          "lehrring",
                          "lehrdorn",
                          "einstellring",
                          "einstellmass",
                          "einstellstuck",
                          "einstellnormal",
                          "grenzlehre",
                          "standard resistor",
                          "normalwiderstand",
                          "standard capacitor",
                          "normalkondensator",
                          "attenuator",
                          "dampfungsglied",
                          "termination",
                          "reference material",
                          "referenzmaterial",
                          "line scale",
                          "glass scale",
                          "glasmassstab",
                          "ball plate",
                          "kugelplatte",
                          "angle block",
                          "winkelendmass",
                          "surface plate",
                          "optical flat",
                          "planglas",
                          "gas mixture",
                          "gasgemisch",
                          "volumetric flask",
                          "messkolben"}) &&
           !words.has_any({"balance", "*waage",     "comparator", "komparator", "instrument", "*messgerat",
                           "meter ",  "meters ",    "indicator",  "calibrator", "kalibrator", "bridge",
                           "brucke",  "microscope", "mikroskop",  "machine",    "maschine",   "scanner",
                           "with ",   "mit ",       "using "});
}

bool is_scatter_of_readings(const AuditedRow& row) {
    switch (row.contributor) {
        case temperature:
        case expansion:
        case environment:
        case refractive_index:
        case reference_drift:
            return false;  // readings of what acts on the result
        default:
            return !row.readings.empty() || row.pooled_s || row.origin == Origin::readings;
    }
}

NamedRow::NamedRow(const AuditedRow& row)
    : contributors_{row.contributor},
      is_scatter_(is_scatter_of_readings(row)),
      is_certified_(row.origin == Origin::certificate && row.origin_value && row.certificate_k),
      words_{WordLine(row.quantity), WordLine(row.description), WordLine(row.comment), WordLine(row.source)} {
    for (const std::string_view name : {std::string_view(row.quantity), std::string_view(row.description)}) {
        const std::vector<std::string_view> parts = parts_of_name(cut(name, k_longest_text));
        for (const std::string_view part : parts) {
            if (parts.size() > 1) {
                contributors_.push_back(contributor_of(part, "", ""));
            }
        }
    }
}

bool NamedRow::stands_for(const RequiredContributor& required) const {
    const auto asks = [&required](Contributor contributor) {
        return std::find(required.by.begin(), required.by.end(), contributor) != required.by.end();
    };
    return std::any_of(contributors_.begin(), contributors_.end(), asks) || (is_scatter_ && asks(repeatability)) ||
           (is_certified_ && required.by_certificate) ||
           std::any_of(words_.begin(), words_.end(),
                       [&required](const WordLine& words) { return words.has_any(required.words); });
}

bool stands_for(const AuditedRow& row, const RequiredContributor& required) {
    return NamedRow(row).stands_for(required);
}

}  // namespace gumcert::audit
