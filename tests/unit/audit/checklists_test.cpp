#include "audit/checklists.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "audit/row_meaning.h"

namespace gumcert::audit {
namespace {

TEST(Checklists, have_ids_and_contributors_that_a_row_can_be) {
    std::set<std::string_view> ids;
    for (const MethodChecklist& checklist : method_checklists()) {
        EXPECT_TRUE(ids.insert(checklist.method).second) << checklist.method;
        EXPECT_FALSE(checklist.title.empty());
        EXPECT_FALSE(checklist.source.empty()) << checklist.method;
        EXPECT_FALSE(checklist.required.empty());
        for (const RequiredContributor& required : checklist.required) {
            EXPECT_FALSE(required.by.empty() && required.words.empty()) << required.name.english();
        }
        EXPECT_EQ(checklist_of(checklist.method), &checklist);
    }
    EXPECT_EQ(ids.size(), 16U);
    EXPECT_EQ(minimum_contributors().size(), 6U);
    EXPECT_EQ(checklist_of("unknown"), nullptr);
}

TEST(Checklists, know_their_method_by_its_title) {
    EXPECT_EQ(method_in_title("Rotary table by multilateration"), "rotary_table_multilateration");
    EXPECT_EQ(method_in_title("Rotary table, A axis, against a polygon of 36 sides, full closure"), "");
    EXPECT_EQ(method_in_title("Parallelendmaß im Vergleich"), "end_gauge_comparison");
    EXPECT_EQ(method_in_title("Bügelmessschraube, Messschraube 25 mm"), "caliper_micrometer");
    EXPECT_EQ(method_in_title("Messuhr"), "dial_indicator");
    EXPECT_EQ(method_in_title("weights F1"), "weights");
    EXPECT_EQ(method_in_title("Kalibrierung einer Präzisionswaage mit Gewichten"), "balance");
    EXPECT_EQ(method_in_title("Calibration of a balance"), "balance");
    EXPECT_EQ(method_in_title("Rohrfedermanometer 10 bar"), "pressure");
    EXPECT_EQ(method_in_title("Druckaufnehmer"), "pressure");
    EXPECT_EQ(method_in_title("Kolbenhubpipette 100 µL"), "pipette");
    EXPECT_EQ(method_in_title("digital oscilloscope, vertical deflection"), "oscilloscope");
    EXPECT_EQ(method_in_title("Stoppuhr"), "time_interval");
    EXPECT_EQ(method_in_title("Härteprüfmaschine Rockwell C"), "hardness");
    EXPECT_EQ(method_in_title("Zugprüfmaschine 100 kN"), "force");
    EXPECT_EQ(method_in_title("load cell 5 kN"), "force");
    EXPECT_EQ(method_in_title("viscosity"), "");
}

// The law: one word of its own tells the method of a checklist, and no longer where another instrument is named by it.
TEST(Checklists, are_not_of_other_instruments_with_a_word_of_theirs) {
    for (const MethodChecklist& checklist : method_checklists()) {
        for (const std::string_view word : checklist.words) {
            std::string title(word.substr(word.starts_with('*') ? 1 : 0));
            EXPECT_EQ(method_in_title(title), checklist.method) << title;
            for (const std::string_view other : checklist.not_with) {
                title = std::string(other.substr(other.starts_with('*') ? 1 : 0)) + " " + std::string(word);
                EXPECT_NE(method_in_title(title), checklist.method) << title;
            }
        }
    }
    for (const char* const title : {"Sound level calibrator 94 dB",
                                    "Vibration calibrator",
                                    "Dry block calibrator",
                                    "Torque transducer 100 N m",
                                    "Drehmomentaufnehmer",
                                    "Reference torque machine",
                                    "Thermocouple type N at 600 °C",
                                    "Digital thermometer with thermocouple type K",
                                    "Thermoelement Typ K",
                                    "Infrared radiation thermometer",
                                    "Strahlungsthermometer",
                                    "Liquid-in-glass thermometer",
                                    "Flüssigkeits-Glasthermometer",
                                    "Hardness of water, titration",
                                    "Wasserhärte, Titration",
                                    "Shore hardness durometer",
                                    "Shore-Härteprüfmaschine",
                                    "Dead weight tester",
                                    "Kolbendruckwaage 5 MPa",
                                    "Wasserwaage",
                                    "Molecular weight by light scattering",
                                    "Sphygmomanometer",
                                    "Stage micrometer 1 mm",
                                    "Volumetric flow meter",
                                    "Drehmoment-Prüfmaschine"}) {
        EXPECT_EQ(method_in_title(title), "") << title;
    }
    EXPECT_EQ(method_in_title("Multifunction calibrator, 10 V DC"), "multimeter");
    EXPECT_EQ(method_in_title("Drehmomentschlüssel 200 N m"), "torque_wrench");
    EXPECT_EQ(method_in_title("Setting torque wrench"), "torque_wrench");
    EXPECT_EQ(method_in_title("Widerstandsthermometer im Flüssigkeitsbad"), "thermometer");
}

TEST(Checklists, look_at_the_description_beside_a_symbol) {
    AuditedRow row;
    row.quantity = "m";
    const RequiredContributor weighing{"weighing (balance)", {}, {"balance", "weighing"}};
    EXPECT_FALSE(stands_for(row, weighing));
    row.description = "weighing, mass of the water";
    EXPECT_TRUE(stands_for(row, weighing));
}

TEST(Checklists, name_a_method_in_words) {
    EXPECT_EQ(method_in_words("cmm_fixture"), "Measurement of a fixture by CMM");
    EXPECT_EQ(method_in_words("SOP 17"), "SOP 17");
    EXPECT_EQ(method_in_words(""), "");
}

TEST(Checklists, know_the_rows_of_everyday_budgets_by_their_words) {
    const auto missing = [](const char* method, const std::vector<std::pair<const char*, Contributor>>& rows) {
        std::string names;
        for (const RequiredContributor& required : checklist_of(method)->required) {
            const bool there = std::any_of(rows.begin(), rows.end(), [&](const auto& named) {
                AuditedRow row;
                row.quantity = named.first;
                row.contributor = named.second;
                return stands_for(row, required);
            });
            names += there ? "" : required.name.english() + "; ";
        }
        return names;
    };
    using enum Contributor;
    EXPECT_EQ(missing("balance", {{"Prüfgewichte", reference},
                                  {"Teilungswert d", item_resolution},
                                  {"Wiederholpräzision", repeatability},
                                  {"Exzentrische Belastung", other},
                                  {"Luftauftrieb", environment},
                                  {"Konvektion", other}}),
              "")
        << "parts of compound words count";
    EXPECT_EQ(missing("pipette", {{"Waage", reference},
                                  {"water temperature", temperature},
                                  {"air buoyancy", environment},
                                  {"evaporation", other},
                                  {"cubic expansion", expansion},
                                  {"repeatability", repeatability}}),
              "");
    EXPECT_EQ(missing("pressure", {{"pressure balance", reference},
                                   {"Höhendifferenz", other},
                                   {"Nullpunkt", other},
                                   {"Umkehrspanne", other},
                                   {"repeatability", repeatability},
                                   {"temperature", temperature}}),
              "");
    EXPECT_EQ(
        missing("force", {{"transfer standard", reference}}),
        "drift of the force standard; repeatability and reproducibility (mounting positions); reversibility; zero "
        "point; resolution; temperature; ");
}

/// The law: readings and pooled deviations are repeatability by any name, unless a condition was read.
TEST(Checklists, know_repeatability_by_its_readings) {
    using enum Contributor;
    const RequiredContributor repeats{"repeatability", {repeatability}, {}};
    for (const Contributor contributor : {other, reference, item, item_resolution, alignment, temperature, expansion,
                                          environment, refractive_index, reference_drift}) {
        const bool is_condition = contributor == temperature || contributor == expansion ||
                                  contributor == environment || contributor == refractive_index ||
                                  contributor == reference_drift;
        AuditedRow row;
        row.quantity = "weighing difference";
        row.contributor = contributor;
        EXPECT_FALSE(stands_for(row, repeats));
        row.pooled_s = 0.003;
        EXPECT_EQ(stands_for(row, repeats), !is_condition) << static_cast<int>(contributor);
        row.pooled_s.reset();
        row.readings = {1.0, 1.1, 1.2};
        EXPECT_EQ(stands_for(row, repeats), !is_condition) << static_cast<int>(contributor);
        EXPECT_FALSE(stands_for(row, {"reproducibility", {reproducibility}, {}}));
    }
}

TEST(Checklists, know_the_buoyancy_by_the_densities) {
    for (const char* const method : {"balance", "weights"}) {
        const auto& required = checklist_of(method)->required;
        const auto buoyancy = std::find_if(required.begin(), required.end(), [](const RequiredContributor& one) {
            return one.name.english() == "air buoyancy";
        });
        ASSERT_NE(buoyancy, required.end());
        for (const char* const quantity : {"rho_a, density of air", "density of the weight", "Dichte der Luft",
                                           "Luftdichte", "air buoyancy", "Luftauftrieb"}) {
            AuditedRow row;
            row.quantity = quantity;
            EXPECT_TRUE(stands_for(row, *buoyancy)) << quantity;
        }
    }
}

TEST(Checklists, accept_a_row_by_contributor_or_word) {
    const RequiredContributor buoyancy{"air buoyancy", {}, {"buoyancy", "auftrieb"}};
    AuditedRow row;
    row.contributor = Contributor::environment;
    EXPECT_FALSE(stands_for(row, buoyancy));
    row.comment = "Auftriebskorrektur";
    EXPECT_TRUE(stands_for(row, buoyancy));
    EXPECT_TRUE(stands_for(row, {"environment", {Contributor::environment}, {}}));
}

/// The law: what a checklist asks for is there where a row is called so, alone or as a part of another name.
TEST(Checklists, find_what_they_ask_for_by_its_own_name) {
    const auto is_found = [](const RequiredContributor& required, const std::string& quantity) {
        AuditedRow row;
        row.quantity = quantity;
        row.contributor = contributor_of(quantity, "", "");
        return stands_for(row, required);
    };
    std::vector<const RequiredContributor*> all;
    for (const MethodChecklist& checklist : method_checklists()) {
        for (const RequiredContributor& required : checklist.required) {
            all.push_back(&required);
        }
    }
    for (const RequiredContributor& required : minimum_contributors()) {
        all.push_back(&required);
    }
    for (const RequiredContributor* required : all) {
        const std::string name = required->name.english();
        EXPECT_TRUE(is_found(*required, name)) << name;
        EXPECT_TRUE(is_found(*required, "Other effects (" + name + ")")) << name;
    }
    const MethodChecklist* const cmm = checklist_of("cmm_fixture");
    for (const RequiredContributor& required : cmm->required) {
        if (required.name.english() == "clamping and datum of the workpiece") {
            EXPECT_TRUE(is_found(required, "Reproducibility (clamping, datum)"));
            EXPECT_TRUE(is_found(required, "Aufspannung und Reproduzierbarkeit"));
            EXPECT_FALSE(is_found(required, "Reproducibility"));
        }
    }
}

}  // namespace
}  // namespace gumcert::audit
