#include "audit/rules/constant_ranges.h"

#include <string>
#include <vector>

#include "audit/row_edits.h"

namespace gumcert::audit {
namespace {

/// One kind: a word of the quantity and a word of the material. No material: the quantity alone decides.
struct KnownConstant {
    ConstantRange range;
    std::vector<std::string_view> property, material;
};

const std::vector<std::string_view> k_expansion = {"expansion", "ausdehnung", "cte", "alpha", "α"};
const std::vector<std::string_view> k_density = {"density", "dichte", "rho", "ρ"};
const std::vector<std::string_view> k_heat = {"specific heat", "heat capacity", "wärmekapazität"};

const std::vector<KnownConstant> k_constants = {
    KnownConstant{{say("thermal expansion of steel"), "1/K", 9e-6, 18e-6},
                  k_expansion,
                  {"steel", "stahl", "gauge block", "endma"}},
    KnownConstant{{say("thermal expansion of aluminium"), "1/K", 19e-6, 26e-6}, k_expansion, {"alumin", "alu "}},
    KnownConstant{{say("thermal expansion of granite"), "1/K", 3e-6, 11e-6}, k_expansion, {"granit"}},
    KnownConstant{{say("thermal expansion of invar"), "1/K", 0.2e-6, 3e-6}, k_expansion, {"invar"}},
    KnownConstant{{say("thermal expansion of brass"), "1/K", 17e-6, 22e-6}, k_expansion, {"brass", "messing"}},
    KnownConstant{
        {say("thermal expansion of tungsten carbide"), "1/K", 3.5e-6, 8e-6}, k_expansion, {"carbide", "hartmetall"}},
    KnownConstant{{say("thermal expansion of a ceramic"), "1/K", 2e-6, 12e-6}, k_expansion, {"ceramic", "keramik"}},
    KnownConstant{{say("thermal expansion of a glass ceramic"), "1/K", -0.2e-6, 0.2e-6}, k_expansion, {"zerodur"}},
    // Air from 900 hPa at 30 °C to 1050 hPa at 10 °C.
    KnownConstant{{say("density of air"), "kg m-3", 0.9, 1.4}, k_density, {"air", "luft"}},
    KnownConstant{{say("density of water"), "kg m-3", 950.0, 1001.0}, k_density, {"water", "wasser"}},
    KnownConstant{{say("density of steel"), "kg m-3", 7500.0, 8200.0}, k_density, {"steel", "stahl"}},
    KnownConstant{{say("density of aluminium"), "kg m-3", 2550.0, 2900.0}, k_density, {"alumin"}},
    KnownConstant{{say("density of brass"), "kg m-3", 8300.0, 8800.0}, k_density, {"brass", "messing"}},
    KnownConstant{{say("density of a weight"), "kg m-3", 2500.0, 22600.0}, k_density, {"weight", "gewicht", "mass "}},
    KnownConstant{{say("density of mercury"), "kg m-3", 13400.0, 13700.0}, k_density, {"mercury", "quecksilber"}},
    KnownConstant{{say("refractive index of air less 1"), "1", 1.5e-4, 3.5e-4}, {"refractivity", "n-1", "n - 1"}, {}},
    KnownConstant{{say("refractive index of air"), "1", 1.00015, 1.00035},
                  {"refractive index", "brechzahl", "brechungsindex"},
                  {"air", "luft"}},
    KnownConstant{{say("specific heat capacity of water"), "J kg-1 K-1", 4150.0, 4250.0}, k_heat, {"water", "wasser"}},
    KnownConstant{{say("specific heat capacity of air"), "J kg-1 K-1", 990.0, 1030.0}, k_heat, {"air", "luft"}},
    // 9.764 m/s² on the highest mountain of the tropics, 9.834 m/s² at the poles.
    KnownConstant{{say("local acceleration of free fall"), "m s-2", 9.76, 9.84},
                  {"free fall", "gravity", "fallbeschleunigung", "gravitation"},
                  {}},
    KnownConstant{{say("temperature coefficient of platinum"), "1/K", 3.7e-3, 4.0e-3},
                  {"temperature coefficient", "temperaturkoeffizient"},
                  {"pt100", "pt-100", "platin"}},
};

}  // namespace

const ConstantRange* constant_range(const AuditedRow& row) {
    const std::string text = text_of_row(row);
    for (const KnownConstant& constant : k_constants) {
        if (mentions(text, constant.property) && (constant.material.empty() || mentions(text, constant.material))) {
            return &constant.range;
        }
    }
    return nullptr;
}

}  // namespace gumcert::audit
