"""The commands of python -m onset_ccd, in the words of the native command line."""
