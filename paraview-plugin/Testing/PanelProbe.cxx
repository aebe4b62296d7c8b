/// Tells what ParaView's properties panel shows, for a test that runs inside of ParaView
/// (panel.py): its Python knows no Qt.

#include <QApplication>
#include <QByteArray>
#include <QHeaderView>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QScrollArea>
#include <QScrollBar>
#include <QString>
#include <QTableWidget>
#include <QWidget>

namespace
{

QJsonObject tablesOf(const QWidget& panel)
{
  QJsonObject tables;
  for (const QTableWidget* table : panel.findChildren<QTableWidget*>())
  {
    QJsonArray heads;
    bool whole = true;
    for (int column = 0; table->isVisible() && column < table->columnCount(); ++column)
    {
      const QString head = table->horizontalHeaderItem(column)->text();
      const int room = table->columnWidth(column);
      heads << head;
      whole = whole && table->fontMetrics().horizontalAdvance(head) <= room;
    }
    const QString name = table->parentWidget()->objectName();
    tables[name] = QJsonObject{ { "heads", heads }, { "whole", whole },
      { "rows", table->rowCount() }, { "width", table->width() } };
  }
  return tables;
}

/// The property that the widget is for; what is ParaView's own has none of ours.
QString propertyOf(const QWidget* widget, const QWidget& content)
{
  for (; widget && widget != &content; widget = widget->parentWidget())
  {
    if (widget->inherits("pqPropertyWidget"))
    {
      return widget->objectName();
    }
  }
  return QString();
}

/// Widgets that would have to be narrower: how far each reaches at least, with what it shows.
QJsonArray wideWidgets(const QWidget& content, int width)
{
  QJsonArray wide;
  for (const QWidget* one : content.findChildren<QWidget*>())
  {
    const int right = one->mapTo(&content, QPoint(0, 0)).x() + one->minimumSizeHint().width();
    if (one->isVisible() && right > width && one->findChildren<QWidget*>().isEmpty() &&
      !one->inherits("QScrollBar"))
    {
      const auto* const label = qobject_cast<const QLabel*>(one);
      wide << QJsonObject{ { "class", one->metaObject()->className() }, { "right", right },
        { "property", propertyOf(one, content) }, { "text", label ? label->text() : QString() } };
    }
  }
  return wide;
}

} // namespace

/// JSON, until the next call; "{}" while there is no panel. Called by the thread of the window.
extern "C" Q_DECL_EXPORT const char* pointfrontPanel()
{
  static QByteArray told;
  QJsonObject found;
  for (const QWidget* panel : QApplication::allWidgets())
  {
    if (panel->objectName() != "propertiesPanel")
    {
      continue;
    }
    for (const QScrollArea* area : panel->findChildren<QScrollArea*>())
    {
      if (!area->widget() || !area->isVisible())
      {
        continue;
      }
      const int width = area->viewport()->width();
      found["panel"] = panel->width();
      found["width"] = width;
      found["content"] = area->widget()->minimumSizeHint().width();
      found["sideways"] = area->horizontalScrollBar()->isVisible();
      found["wide"] = wideWidgets(*area->widget(), width);
      found["tables"] = tablesOf(*area->widget());
    }
  }
  told = QJsonDocument(found).toJson(QJsonDocument::Compact);
  return told.constData();
}

/// As who types into a cell of a table; false if there is none.
extern "C" Q_DECL_EXPORT bool pointfrontWrite(
  const char* property, int row, int column, const char* text)
{
  for (QWidget* widget : QApplication::allWidgets())
  {
    auto* const table = qobject_cast<QTableWidget*>(widget);
    if (table && table->isVisible() && table->parentWidget()->objectName() == property)
    {
      QTableWidgetItem* const cell = table->item(row, column);
      cell ? cell->setText(text) : void();
      return cell != nullptr;
    }
  }
  return false;
}
