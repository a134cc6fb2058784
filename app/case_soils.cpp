// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_soils.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace berm::app
{
namespace
{
constexpr double radians = pi / 180;

class SoilAssembler
{
public:
  SoilAssembler(const CheckedValues& values, bool needs_conductivity,
                std::vector<Mistake>& mistakes)
      : values_(values), needs_conductivity_(needs_conductivity), mistakes_(mistakes)
  {
  }

  std::vector<coupling::Soil> soils()
  {
    std::vector<coupling::Soil> result;
    for (const std::string& name : values_.soils)
    {
      const std::string at = "soil." + name + ".";
      const auto si = [&](const char* key, double factor)
      { return number(at + key, NAN) * factor; };
      coupling::Soil soil;
      soil.name = name;
      auto& m = soil.mechanical;
      m.density = si("unit_weight_kN_m3", 1e3 / gravity);
      m.saturated_density =
          number(at + "saturated_unit_weight_kN_m3", m.density * gravity / 1e3) * 1e3 / gravity;
      if (!values_.has(at + "saturated_unit_weight_kN_m3"))
        m.saturated_density = m.density;
      m.cohesion = si("cohesion_kPa", 1e3);
      m.friction_angle = si("friction_angle_deg", radians);
      m.dilation_angle = si("dilation_angle_deg", radians);
      m.young_modulus = si("young_modulus_kPa", 1e3);
      m.poisson_ratio = si("poisson_ratio", 1);
      m.tensile_strength = number(at + "tensile_strength_kPa", INFINITY) * 1e3;
      check_soil(at, m);
      const seepage::Retention retention = assemble_retention(at + "retention.");
      if (const auto k = values_.get<std::vector<double>>(at + "conductivity_m_s"))
        soil.conductivity = seepage::Conductivity{(*k)[0], (*k)[1],
                                                  si("conductivity_angle_deg", radians), retention};
      else if (needs_conductivity_ && !given(at + "conductivity_m_s"))
        add({.key = at + "conductivity_m_s",
             .problem = std::string(missing_key),
             .hint = "every soil needs one where the pore pressure comes from a seepage solve"});
      result.push_back(std::move(soil));
    }
    return result;
  }

private:
  double number(const std::string& path, double otherwise) const
  {
    return values_.get<double>(path).value_or(otherwise);
  }
  bool given(const std::string& path) const { return was_given(values_, mistakes_, path); }
  void add(Mistake mistake) { mistakes_.push_back(std::move(mistake)); }

  seepage::Retention assemble_retention(const std::string& at)
  {
    using enum seepage::RetentionModel;
    constexpr double bounded_from = 2, air_entry = 0.02; // n [-] and [m], docs/theory.md eq. (2.43)
    const auto model = values_.get<std::string>(at + "model");
    if (!model) // wrong: reported already
      return {};
    seepage::Retention retention;
    retention.model = *model == "gardner"         ? gardner
                      : *model == "van_genuchten" ? van_genuchten
                                                  : sharp;
    const auto belongs = [&](const char* key, bool wanted, bool required)
    {
      if (wanted && required && !given(at + key))
        add({.key = at + key,
             .problem = std::string(missing_key),
             .hint = fmt::format("model = \"{}\" needs it", *model)});
      else if (!wanted && given(at + key))
        add({.key = at + key,
             .value = fmt::format("{}", number(at + key, NAN)),
             .problem = fmt::format("model = \"{}\" has none", *model),
             .hint = "see soil.*.retention.model in `berm reference`"});
    };
    const bool has_curve = retention.model == van_genuchten;
    belongs("alpha_1_m", retention.model != sharp, true);
    belongs("van_genuchten_n", has_curve, true);
    belongs("mualem_l", has_curve, false);
    belongs("air_entry_m", has_curve, false);
    retention.alpha = number(at + "alpha_1_m", 0);
    retention.n = number(at + "van_genuchten_n", 0);
    retention.l = number(at + "mualem_l", retention.l);
    retention.air_entry = number(at + "air_entry_m", retention.n < bounded_from ? air_entry : 0);
    return retention;
  }

  void check_soil(const std::string& at, const sph::Soil& m)
  {
    if (m.dilation_angle > m.friction_angle)
      add({.key = at + "dilation_angle_deg",
           .value = fmt::format("{}", number(at + "dilation_angle_deg", 0)),
           .allowed = fmt::format("0 <= dilation_angle_deg <= friction_angle_deg = {}",
                                  number(at + "friction_angle_deg", 0))});
    if (m.saturated_density < m.density)
      add({.key = at + "saturated_unit_weight_kN_m3",
           .value = fmt::format("{}", number(at + "saturated_unit_weight_kN_m3", 0)),
           .allowed = fmt::format("saturated_unit_weight_kN_m3 >= unit_weight_kN_m3 = {}",
                                  number(at + "unit_weight_kN_m3", 0))});
  }

  const CheckedValues& values_;
  bool needs_conductivity_;
  std::vector<Mistake>& mistakes_;
};
} // namespace

std::vector<coupling::Soil> assemble_soils(const CheckedValues& values, bool needs_conductivity,
                                           std::vector<Mistake>& mistakes)
{
  return SoilAssembler(values, needs_conductivity, mistakes).soils();
}
} // namespace berm::app
