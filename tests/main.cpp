#define ONSET_CATCH_MAIN
#include "tests/catch.hpp"

#if ONSET_CATCH_VERSION == 3
#include <catch2/catch_session.hpp>
int main(int argc, char** argv) { return Catch::Session().run(argc, argv); }
#endif
