// The papers: one function each, defined in the file of that name, put together in registry.cpp.
#pragma once

#include "validation/paper.hpp"

namespace xpr::papers {

[[nodiscard]] Paper darwin_1959();
[[nodiscard]] Paper iyer_petters_2007();
[[nodiscard]] Paper bozza_2002();
[[nodiscard]] Paper virbhadra_ellis_2000();
[[nodiscard]] Paper synge_1966();
[[nodiscard]] Paper shapiro_1964();
[[nodiscard]] Paper redshift_doppler();
[[nodiscard]] Paper isotropic_index();
[[nodiscard]] Paper eiroa_romero_torres_2002();
[[nodiscard]] Paper kerr_1963();
[[nodiscard]] Paper bardeen_press_teukolsky_1972();
[[nodiscard]] Paper iyer_hansen_2009();
[[nodiscard]] Paper sereno_de_luca_2006();
[[nodiscard]] Paper bardeen_1973();
[[nodiscard]] Paper teo_2003();
[[nodiscard]] Paper johnson_2020();
[[nodiscard]] Paper gralla_lupsasca_2020();
[[nodiscard]] Paper james_2015_dngr();
[[nodiscard]] Paper cunningham_bardeen_1973();
[[nodiscard]] Paper luminet_1979();
[[nodiscard]] Paper page_thorne_1974();
[[nodiscard]] Paper gralla_holz_wald_2019();
[[nodiscard]] Paper nakajima_asada_2012();
[[nodiscard]] Paper tsukamoto_2016();
[[nodiscard]] Paper james_2015_wormhole();
[[nodiscard]] Paper penrose_1959();
[[nodiscard]] Paper luneburg_1944();
[[nodiscard]] Paper maxwell_1854();
[[nodiscard]] Paper eaton_1952();
[[nodiscard]] Paper selfoc_fibre();
[[nodiscard]] Paper exponential_atmosphere();
[[nodiscard]] Paper leonhardt_piwnicki_1999();
[[nodiscard]] Paper karney_2013();

}  // namespace xpr::papers
