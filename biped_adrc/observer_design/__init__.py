"""What an observer asks of encoders, clock and motors, and which bandwidth they allow."""
