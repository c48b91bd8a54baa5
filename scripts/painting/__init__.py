"""A small painter of trees and landscapes for the example pictures; numpy and Pillow only."""
