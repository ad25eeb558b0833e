#include "validation/papers/papers.hpp"

namespace xpr {

const std::vector<Paper>& all_papers() {
  using namespace papers;
  static const std::vector<Paper> all = {
      darwin_1959(),                   //
      iyer_petters_2007(),             //
      bozza_2002(),                    //
      virbhadra_ellis_2000(),          //
      synge_1966(),                    //
      shapiro_1964(),                  //
      redshift_doppler(),              //
      isotropic_index(),               //
      eiroa_romero_torres_2002(),      //
      kerr_1963(),                     //
      bardeen_press_teukolsky_1972(),  //
      iyer_hansen_2009(),              //
      sereno_de_luca_2006(),           //
      bardeen_1973(),                  //
      teo_2003(),                      //
      johnson_2020(),                  //
      gralla_lupsasca_2020(),          //
      james_2015_dngr(),               //
      cunningham_bardeen_1973(),       //
      luminet_1979(),                  //
      page_thorne_1974(),              //
      gralla_holz_wald_2019(),         //
      nakajima_asada_2012(),           //
      tsukamoto_2016(),                //
      james_2015_wormhole(),           //
      penrose_1959(),                  //
      luneburg_1944(),                 //
      maxwell_1854(),                  //
      eaton_1952(),                    //
      selfoc_fibre(),                  //
      exponential_atmosphere(),        //
      leonhardt_piwnicki_1999(),       //
      karney_2013(),                   //
  };
  return all;
}

}  // namespace xpr
