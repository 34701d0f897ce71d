"""What the tools share: result files, spectra, regions and phase space, as they read and draw them."""
