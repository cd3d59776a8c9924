#define ONSET_ISA values_plain
#define ONSET_KERNEL_VALUES kernel_values_plain
#define ONSET_CERTIFICATES certificates_plain
#define ONSET_CONTACT_VALUES contact_values_plain
#include "tests/narrowphase/kernel/kernel_values.inl"
