#include "tests/ocio/config_fixture.h"
